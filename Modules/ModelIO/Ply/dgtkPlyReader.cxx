// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelBuilder.h"
#include "dgtkPlyHeader.h"
#include "dgtkTextLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

namespace dgtk
{

namespace
{
/// Reads the numbers of the body, whatever their encoding.
class PlyBody
{
public:
  PlyBody(const std::string& path, const std::string& contents, const PlyHeader& header)
    : Path(path)
    , Contents(contents)
    , Encoding(header.encoding)
    , At(header.bodyAt)
  {
  }

  std::size_t at() const { return this->At; }
  void seek(std::size_t at) { this->At = at; }

  double number(PlyType type)
  {
    return this->Encoding == PlyHeader::Encoding::Ascii ? this->text() : this->binary(type);
  }

  /// Number of items of a list; refused when they cannot follow.
  std::uint64_t listCount(const PlyProperty& property)
  {
    const double count = this->number(property.countType);
    const bool ascii = this->Encoding == PlyHeader::Encoding::Ascii;
    const std::uint64_t most = (this->Contents.size() - this->At + 1) / (ascii ? 2 : bytesOf(property.type));
    if (!(count >= 0) || count > static_cast<double>(most) || count != std::floor(count))
    {
      this->fail("list " + quoted(property.name) + " has an impossible count", "at most " + std::to_string(most),
        std::isfinite(count) && std::fabs(count) < 1e15 ? std::to_string(static_cast<long long>(count)) : "no number");
    }
    return static_cast<std::uint64_t>(count);
  }

  void skip(const PlyElement& element)
  {
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
      for (const PlyProperty& property : element.properties)
      {
        this->skip(property);
      }
    }
  }

  void skip(const PlyProperty& property)
  {
    const std::uint64_t count = property.isList ? this->listCount(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i)
    {
      this->number(property.type);
    }
  }

private:
  [[noreturn]] void fail(const std::string& what, const std::string& expected, const std::string& found)
  {
    long line = 0;
    if (this->Encoding == PlyHeader::Encoding::Ascii)
    {
      const auto end = this->Contents.begin() + static_cast<std::ptrdiff_t>(std::min(this->At, this->Contents.size()));
      line = 1 + static_cast<long>(std::count(this->Contents.begin(), end, '\n'));
    }
    throw InputError(this->Path, line, what + (line ? "" : " at byte " + std::to_string(this->At)), expected, found);
  }

  double text()
  {
    const char* const begin = this->Contents.data();
    const char* const end = begin + this->Contents.size();
    const char* p = begin + this->At;
    while (p < end && (*p == ' ' || *p == '\t' || *p == '\n' || *p == '\r'))
    {
      ++p;
    }
    this->At = static_cast<std::size_t>(p - begin);
    if (p == end)
    {
      this->fail("ends too soon", "a number", "end of file");
    }
    p += *p == '+' ? 1 : 0;
    double value = 0;
    const auto parsed = std::from_chars(p, end, value);
    const bool separated = parsed.ptr == end || std::strchr(" \t\r\n", *parsed.ptr) != nullptr;
    if (parsed.ec == std::errc::invalid_argument || !separated)
    {
      const char* word = p;
      while (word < end && std::strchr(" \t\r\n", *word) == nullptr)
      {
        ++word;
      }
      this->fail("is no number", "a number", quoted(std::string(p, std::min<std::ptrdiff_t>(word - p, 60))));
    }
    this->At = static_cast<std::size_t>(parsed.ptr - begin);
    const std::string_view word(p, static_cast<std::size_t>(parsed.ptr - p));
    return parsed.ec == std::errc::result_out_of_range ? *parseNumber(word) : value;
  }

  template <class T>
  double binaryOf()
  {
    unsigned char bytes[sizeof(T)];
    if (this->Contents.size() - this->At < sizeof(T))
    {
      this->fail("ends too soon", "a number of " + std::to_string(sizeof(T)) + " bytes", "end of file");
    }
    std::memcpy(bytes, this->Contents.data() + this->At, sizeof(T));
    this->At += sizeof(T);
    const std::uint16_t probe = 1;
    const bool machineIsLittle = *reinterpret_cast<const unsigned char*>(&probe) == 1;
    if ((this->Encoding == PlyHeader::Encoding::Little) != machineIsLittle)
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
  }

  double binary(PlyType type)
  {
    static constexpr double (PlyBody::*readers[])() = { &PlyBody::binaryOf<std::int8_t>,
      &PlyBody::binaryOf<std::uint8_t>, &PlyBody::binaryOf<std::int16_t>, &PlyBody::binaryOf<std::uint16_t>,
      &PlyBody::binaryOf<std::int32_t>, &PlyBody::binaryOf<std::uint32_t>, &PlyBody::binaryOf<float>,
      &PlyBody::binaryOf<double> }; // in the order of PlyType
    return (this->*readers[static_cast<std::size_t>(type)])();
  }

  const std::string& Path;
  const std::string& Contents;
  PlyHeader::Encoding Encoding;
  std::size_t At;
};

class PlyAssembly
{
public:
  PlyAssembly(const std::string& path, const std::string& contents, const ReadOptions& options)
    : Header(readPlyHeader(path, contents))
    , Body(path, contents, this->Header)
    , Builder(path, "ply", contents.size(), options)
  {
  }

  ModelContents run(const std::string& path)
  {
    std::vector<std::pair<const PlyElement*, std::size_t>> later;
    bool vertices = false;
    this->Builder.beginObject("mesh");
    for (const PlyElement& element : this->Header.elements)
    {
      if (element.name == "vertex")
      {
        this->readVertices(element);
        vertices = true;
      }
      else if (this->isSurface(element) && vertices)
      {
        this->readSurfaces(element);
      }
      else
      {
        later.emplace_back(&element, this->Body.at());
        this->Body.skip(element);
      }
    }
    if (!vertices)
    {
      throw InputError(path, "has no vertices", "element vertex", "none");
    }
    for (const auto& [element, at] : later)
    {
      if (this->isSurface(*element))
      {
        this->Body.seek(at);
        this->readSurfaces(*element);
      }
    }
    return this->finish();
  }

private:
  static bool isSurface(const PlyElement& element)
  {
    return element.name == "face" || element.name == "tristrips" || element.name == "edge";
  }

  void readVertices(const PlyElement& element)
  {
    const int axes[3] = { element.find({ "x" }), element.find({ "y" }), element.find({ "z" }) };
    const int normals[3] = { element.find({ "nx" }), element.find({ "ny" }), element.find({ "nz" }) };
    PlyColor colors(element);
    const int uvs[2] = { element.find({ "s", "u", "texture_u", "texture_s" }),
      element.find({ "t", "v", "texture_v", "texture_t" }) };
    this->HasUvs = uvs[0] >= 0 && uvs[1] >= 0;
    const bool hasNormals = normals[0] >= 0 && normals[1] >= 0 && normals[2] >= 0;
    std::vector<double> row(element.properties.size() + 1, 0);
    const auto at = [&row](int property) { return PlyElement::valueAt(row, property); };
    this->Builder.reserve(static_cast<std::size_t>(element.count), 0, 0);
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
      for (std::size_t p = 0; p < element.properties.size(); ++p)
      {
        if (element.properties[p].isList)
        {
          this->Body.skip(element.properties[p]);
        }
        else
        {
          row[p] = this->Body.number(element.properties[p].type);
        }
      }
      this->Builder.addVertex({ at(axes[0]), at(axes[1]), at(axes[2]) });
      if (hasNormals)
      {
        this->Normals.push_back(this->Builder.addNormal({ at(normals[0]), at(normals[1]), at(normals[2]) }));
      }
      if (this->HasUvs)
      {
        this->Uvs.push_back({ static_cast<float>(at(uvs[0])), static_cast<float>(at(uvs[1])) });
      }
      if (colors.exists())
      {
        const Eigen::Vector3d color = colors.in(row);
        this->ColorsVary = this->ColorsVary || (i > 0 && color != this->Color);
        this->Colors.push_back(colors.bytesIn(row));
        this->ColorsVary = this->ColorsVary || this->Colors.back()[3] < 255;
        this->Color = color;
        this->HasColors = true;
      }
    }
    this->Vertices = element.count;
    this->warnOfRange(colors);
  }

  void warnOfRange(const PlyColor& colors)
  {
    if (const std::string odd = colors.oddRange(); !odd.empty())
    {
      this->Builder.warn(odd);
    }
  }

  Corner corner(double index) const
  {
    Corner corner;
    const bool known = index >= 0 && index < static_cast<double>(this->Vertices);
    corner.vertex = known ? static_cast<std::uint32_t>(index) : 0xffffffffu;
    if (known && !this->Normals.empty())
    {
      corner.normal = this->Normals[corner.vertex];
    }
    if (known && this->HasUvs)
    {
      corner.u = this->Uvs[corner.vertex][0];
      corner.v = this->Uvs[corner.vertex][1];
    }
    if (known && this->ColorsVary)
    {
      corner.color = this->Colors[corner.vertex];
    }
    return corner;
  }

  /// One for each picture of the header, by its number, and one without; each white where its corners are `colored`.
  int material(double number, bool colored)
  {
    const std::vector<PlyPicture>& pictures = this->Header.pictures;
    const auto count = static_cast<double>(pictures.size());
    const bool isKnown = number >= 0 && number < count;
    this->LostPictures += count > 0 && number >= count ? 1 : 0;
    const std::size_t picture = isKnown ? static_cast<std::size_t>(number) : pictures.size();
    const auto [known, isNew] = this->Materials.try_emplace({ picture, colored }, -1);
    if (isNew && isKnown)
    {
      const int plain = this->material(-1, colored);
      const auto& [name, wrap] = pictures[picture];
      known->second = this->Builder.withTexture(plain, this->Builder.addTexture(name, {}, {}, wrap));
      if (known->second != plain && !this->HasColors)
      {
        this->Builder.model().materials[static_cast<std::size_t>(known->second)].diffuse.setOnes(); // nothing tints it
      }
    }
    else if (isNew)
    {
      dgtk::Material made;
      made.name = "ply";
      if (colored)
      {
        made.diffuse.setOnes();
        this->Builder.setHasColors();
      }
      else if (this->HasColors && this->Color.allFinite())
      {
        made.diffuse = this->Color;
        made.ambient = 0.2 * this->Color;
      }
      known->second = this->Builder.addMaterial(made);
    }
    return known->second;
  }

  void readSurfaces(const PlyElement& element)
  {
    const int indices = element.find({ "vertex_indices", "vertex_index" });
    const int wedges = element.find({ "texcoord" });
    const int ends[2] = { element.find({ "vertex1" }), element.find({ "vertex2" }) };
    const int numbers = element.find({ "texnumber" });
    PlyColor colors(element);
    const bool colored = colors.exists() && !this->HasColors;
    const bool ofFaces = element.name != "edge";
    this->HasNumbers = this->HasNumbers || (ofFaces && numbers >= 0);
    this->LostColors = this->LostColors || (ofFaces && colors.exists() && this->HasColors);
    std::vector<double> row(element.properties.size() + 1, 0);
    std::vector<double> list;
    std::vector<double> uvs;
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
      list.clear();
      uvs.clear();
      for (std::size_t p = 0; p < element.properties.size(); ++p)
      {
        const PlyProperty& property = element.properties[p];
        if (!property.isList)
        {
          row[p] = this->Body.number(property.type);
          continue;
        }
        std::vector<double>* to = static_cast<int>(p) == indices  ? &list
                                  : static_cast<int>(p) == wedges ? &uvs
                                                                  : nullptr;
        for (std::uint64_t left = this->Body.listCount(property); left > 0; --left)
        {
          const double value = this->Body.number(property.type);
          if (to)
          {
            to->push_back(value);
          }
        }
      }
      if (ofFaces)
      {
        this->Material = this->material(PlyElement::valueAt(row, numbers), colored || this->ColorsVary);
        this->FaceColor = colored ? std::optional(colors.bytesIn(row)) : std::nullopt;
      }
      if (element.name == "face")
      {
        this->addFace(list, uvs);
      }
      else if (element.name == "tristrips")
      {
        this->addStrips(list);
      }
      else if (ends[0] >= 0 && ends[1] >= 0)
      {
        this->Builder.addLine(this->corner(row[static_cast<std::size_t>(ends[0])]).vertex,
          this->corner(row[static_cast<std::size_t>(ends[1])]).vertex);
      }
    }
    this->warnOfRange(colors);
  }

  void addFace(const std::vector<double>& list, const std::vector<double>& uvs)
  {
    SurfaceStyle style;
    style.material = this->Material;
    style.shading = Shading::Crease;
    this->Corners.clear();
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      this->Corners.push_back(this->corner(list[i]));
      this->Corners.back().color = this->FaceColor.value_or(this->Corners.back().color);
      if (uvs.size() == 2 * list.size())
      {
        this->Corners.back().u = static_cast<float>(uvs[2 * i]);
        this->Corners.back().v = static_cast<float>(uvs[2 * i + 1]);
        this->HasWedges = true;
      }
    }
    this->Builder.addSurface(this->Corners, style);
  }

  /// -1 ends a strip; every second triangle of a strip turns the other way.
  void addStrips(const std::vector<double>& list)
  {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      if (list[i] < 0)
      {
        begin = i + 1;
      }
      else if (i >= begin + 2)
      {
        const bool odd = (i - begin) % 2 != 0;
        const std::vector<double> triangle = { list[odd ? i - 1 : i - 2], list[odd ? i - 2 : i - 1], list[i] };
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
        {
          this->addFace(triangle, {});
        }
      }
    }
  }

  ModelContents finish()
  {
    if (this->HasUvs || this->HasWedges)
    {
      this->Builder.setHasUvs();
    }
    this->Builder.endObject();
    Model& model = this->Builder.model();
    if (model.triangles.empty())
    {
      this->Builder.warn("has no surfaces: points are not drawn");
    }
    else if (this->Header.pictures.size() > 1 && !this->HasNumbers)
    {
      this->Builder.warn(
        "faces have no texnumber: all have the first picture of " + std::to_string(this->Header.pictures.size()));
    }
    if (this->LostPictures > 0)
    {
      this->Builder.warn(std::to_string(this->LostPictures) + " face(s) name a picture that does not exist");
    }
    if (this->LostColors)
    {
      this->Builder.warn("colours of faces are not drawn: vertices have their own");
    }
    this->Builder.keep({}, ModelContents::worthwhile);
    return this->Builder.finish();
  }

  PlyHeader Header;
  PlyBody Body;
  ModelBuilder Builder;
  std::vector<std::int32_t> Normals;
  std::vector<std::array<float, 2>> Uvs;
  std::vector<std::array<std::uint8_t, 4>> Colors;
  std::vector<Corner> Corners;
  std::uint64_t Vertices = 0;
  Eigen::Vector3d Color{ 0.8, 0.8, 0.8 };
  std::map<std::pair<std::size_t, bool>, int> Materials; ///< by number of the picture, and whether corners are coloured
  int Material = -1;                                     ///< of the face that is read
  std::optional<std::array<std::uint8_t, 4>> FaceColor;
  std::size_t LostPictures = 0; ///< faces
  bool LostColors = false;      ///< of faces
  bool HasNumbers = false;
  bool HasUvs = false;
  bool HasWedges = false;
  bool HasColors = false;
  bool ColorsVary = false;
};
} // namespace

ModelContents readPly(const std::string& path, const ReadOptions& options);
ModelContents readPly(const std::string& path, const ReadOptions& options)
{
  const std::string contents = readFile(path);
  return PlyAssembly(path, contents, options).run(path);
}

} // namespace dgtk
