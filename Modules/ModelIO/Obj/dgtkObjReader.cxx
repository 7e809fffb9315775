// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEqualItems.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelBuilder.h"
#include "dgtkObjMaterials.h"
#include "dgtkObjStatements.h"
#include "dgtkTextLines.h"

#include <algorithm>
#include <optional>

namespace dgtk
{

namespace
{
constexpr std::uint32_t noIndex = 0xffffffffu;
// What a face takes at most while its object is built, bytes.
constexpr std::uint64_t bytesOfCorner = 50;
constexpr std::uint64_t bytesOfTriangle = 30;
constexpr std::uint64_t bytesOfFace = 100;

/// What faces may name before it comes: vertices, texture coordinates, normals and libraries of the whole file.
struct ObjValues
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<float, 2>> uvs;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::array<std::uint8_t, 4>> colors; ///< one a vertex from the first that has one; the rest is white
  bool colored = false;                            ///< some vertex has a colour that is not white
  double brightest = 0;                            ///< component of a colour
  std::vector<std::string> libraries;              ///< what statements `mtllib` say
};

void addVertex(ObjStatements& statements, ObjValues& values)
{
  double v[7] = {};
  const std::size_t count = statements.numbers(v, 7);
  Eigen::Vector3d position(v[0], v[1], v[2]);
  if (count == 4 && v[3] != 0)
  {
    position /= v[3];
  }
  else if (count >= 6)
  {
    values.colored = values.colored || v[3] != 1 || v[4] != 1 || v[5] != 1 || (count == 7 && v[6] != 1);
    values.brightest = std::max({ values.brightest, v[3], v[4], v[5] });
    values.colors.resize(values.positions.size(), { 255, 255, 255, 255 });
    values.colors.push_back(colorBytes(v + 3, count == 7 ? v[6] : 1.0));
  }
  values.positions.push_back(position);
}

ObjValues readValues(const std::string& path, const std::string& text)
{
  ObjValues values;
  ObjStatements statements(path, text);
  while (statements.next())
  {
    double v[3] = {};
    if (statements.keyword() == "v")
    {
      addVertex(statements, values);
    }
    else if (statements.keyword() == "vt")
    {
      statements.numbers(v, 2);
      values.uvs.push_back({ static_cast<float>(v[0]), static_cast<float>(v[1]) });
    }
    else if (statements.keyword() == "vn")
    {
      statements.numbers(v, 3);
      values.normals.emplace_back(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
    }
    else if (statements.keyword() == "mtllib")
    {
      values.libraries.emplace_back(statements.rest());
    }
  }
  return values;
}

/// What a relative or absolute index of a statement means: a place among `total`, `none` when there is no such.
std::uint32_t placeOf(long long index, std::size_t before, std::size_t total)
{
  const long long place = index > 0 ? index - 1 : static_cast<long long>(before) + index;
  return index == 0 || place < 0 || place >= static_cast<long long>(total) ? noIndex
                                                                           : static_cast<std::uint32_t>(place);
}

class ObjAssembly
{
public:
  ObjAssembly(const std::string& path, const std::string& text, const ReadOptions& options)
    : Path(path)
    , Statements(path, text)
    , Values(readValues(path, text))
    , SamePlace(firstOfEqualPoints(this->Values.positions.size(),
        [this](std::size_t i) -> const Eigen::Vector3d& { return this->Values.positions[i]; }))
    , VertexOf(this->Values.positions.size(), noIndex)
    , NormalOf(this->Values.normals.size())
    , MostBytes((std::uint64_t(64) << 20) + 10 * std::uint64_t(text.size()))
    , Builder(path, "obj", text.size(), options)
    , Materials(path, this->Builder)
  {
    this->PlaceOf.reserve(this->SamePlace.size());
    if (this->Values.colored)
    {
      this->Builder.setHasColors();
    }
    for (const std::string& names : this->Values.libraries)
    {
      this->Materials.addLibraries(names);
    }
  }

  ModelContents run()
  {
    bool understood = false;
    while (this->Statements.next())
    {
      understood = this->read(this->Statements.keyword()) || understood;
    }
    if (!understood)
    {
      throw InputError(this->Path, "has nothing of a Wavefront OBJ file", "statements such as v and f", "none");
    }
    this->endObject();
    this->Materials.finish();
    this->warn();
    ModelContents contents = this->Builder.finish();
    for (std::uint32_t& vertex : contents.model->sourceVertex)
    {
      vertex = this->PlaceOf[vertex];
    }
    contents.model->sourceVertices = this->SamePlace.size();
    setSourceOf(*contents.model, std::move(this->SamePlace));
    return contents;
  }

private:
  /// One statement; false when it is none of those that count.
  bool read(std::string_view keyword)
  {
    if (keyword == "v" || keyword == "vt" || keyword == "vn")
    {
      ++(keyword == "v" ? this->Before.vertices : keyword == "vt" ? this->Before.uvs : this->Before.normals);
    }
    else if (keyword == "f" || keyword == "fo")
    {
      this->addFace();
    }
    else if (keyword == "l" || keyword == "p")
    {
      this->addLines(keyword == "l");
    }
    else if (keyword == "o" || keyword == "g")
    {
      const std::string_view name = this->Statements.rest();
      this->setName(std::string(name.empty() ? "default" : name));
    }
    else if (keyword == "usemtl")
    {
      this->MaterialName = this->Statements.rest();
      this->Material.reset();
    }
    else if (keyword == "s")
    {
      const std::string_view group = this->Statements.rest();
      this->Style.shading = group == "off" || group == "0" ? Shading::Flat : Shading::Crease;
    }
    else if (keyword != "mtllib")
    {
      const bool freeForm = keyword == "curv" || keyword == "curv2" || keyword == "surf";
      this->FreeForms += freeForm ? 1 : 0;
      this->Calls += keyword == "call" || keyword == "csh" ? 1 : 0;
      return freeForm;
    }
    return true;
  }

  void setName(const std::string& name)
  {
    if (name != this->Name)
    {
      this->endObject();
      this->Name = name;
    }
  }

  void beginObject()
  {
    if (!this->InObject)
    {
      this->Builder.beginObject(this->Name);
      this->InObject = true;
      this->ObjectBytes = 0;
      this->FirstVertex = this->PlaceOf.size();
      ++this->Objects;
    }
  }

  void endObject()
  {
    if (this->InObject)
    {
      this->Builder.endObject();
      this->InObject = false;
    }
  }

  /// Vertex of the current object at the place of a vertex of the file: those at the same place are one.
  std::uint32_t vertexAt(std::uint32_t place)
  {
    if (place == noIndex)
    {
      return noIndex;
    }
    const std::uint32_t first = this->SamePlace[place];
    std::uint32_t& vertex = this->VertexOf[first];
    if (vertex == noIndex || vertex < this->FirstVertex)
    {
      vertex = this->Builder.addVertex(this->Values.positions[first]);
      this->PlaceOf.push_back(first);
    }
    return vertex;
  }

  std::int32_t normalAt(std::uint32_t place)
  {
    NormalUse& use = this->NormalOf[place];
    if (use.object != this->Objects)
    {
      use = { this->Objects, this->Builder.addNormal(this->Values.normals[place].cast<double>()) };
    }
    return use.normal;
  }

  bool nextCorner(Corner& corner)
  {
    std::array<long long, 3> indices;
    if (!this->Statements.corner(indices))
    {
      return false;
    }
    corner = {};
    corner.vertex = this->vertexAt(placeOf(indices[0], this->Before.vertices, this->Values.positions.size()));
    const std::uint32_t uv = placeOf(indices[1], this->Before.uvs, this->Values.uvs.size());
    const std::uint32_t normal = placeOf(indices[2], this->Before.normals, this->Values.normals.size());
    if (uv != noIndex)
    {
      corner.u = this->Values.uvs[uv][0];
      corner.v = this->Values.uvs[uv][1];
      this->HasUvs = true;
    }
    if (normal != noIndex)
    {
      corner.normal = this->normalAt(normal);
    }
    const std::uint32_t place = placeOf(indices[0], this->Before.vertices, this->Values.positions.size());
    if (this->Values.colored && place < this->Values.colors.size())
    {
      corner.color = this->Values.colors[place];
    }
    this->Lost += (indices[1] != 0 && uv == noIndex ? 1 : 0) + (indices[2] != 0 && normal == noIndex ? 1 : 0);
    return true;
  }

  void readCorners()
  {
    this->beginObject();
    this->Corners.clear();
    for (Corner corner; this->nextCorner(corner);)
    {
      this->Corners.push_back(corner);
    }
  }

  void addFace()
  {
    this->readCorners();
    if (this->Corners.size() == 1)
    {
      ++this->Points;
    }
    else if (this->Corners.size() == 2)
    {
      this->Builder.addLine(this->Corners[0].vertex, this->Corners[1].vertex);
    }
    else
    {
      this->Material = this->Material ? this->Material : this->Materials.indexOf(this->MaterialName);
      this->Style.material = *this->Material;
      this->Materials.place(*this->Material, this->Corners);
      this->ObjectBytes += bytesOfFace + (bytesOfCorner + bytesOfTriangle) * this->Corners.size();
      if (this->ObjectBytes > this->MostBytes)
      {
        throw InputError(this->Path, this->Statements.line(), "has more faces than fit into 10 times its size");
      }
      this->Builder.addSurface(this->Corners, this->Style);
    }
  }

  void addLines(bool connected)
  {
    this->readCorners();
    this->Points += connected ? 0 : this->Corners.size();
    for (std::size_t i = 1; connected && i < this->Corners.size(); ++i)
    {
      this->Builder.addLine(this->Corners[i - 1].vertex, this->Corners[i].vertex);
    }
  }

  void warnOf(std::uint64_t count, const char* one, const char* many)
  {
    if (count > 0)
    {
      this->Builder.warn(std::to_string(count) + (count == 1 ? one : many));
    }
  }

  void warn()
  {
    constexpr double rounding = 1e-3;
    if (this->HasUvs)
    {
      this->Builder.setHasUvs();
    }
    if (this->Values.brightest > 1 + rounding)
    {
      this->Builder.warn("colours of vertices above 1 are drawn as 1, which is white");
    }
    this->warnOf(this->Points, " point is not drawn", " points are not drawn");
    this->warnOf(
      this->FreeForms, " free-form curve or surface is not drawn", " free-form curves and surfaces are not drawn");
    this->warnOf(this->Calls, " statement that puts in what another file or program says (call, csh) is not followed",
      " statements that put in what other files or programs say (call, csh) are not followed");
    this->warnOf(this->Lost, " corner names a texture coordinate or normal that does not exist",
      " corners name texture coordinates or normals that do not exist");
  }

  /// A normal of the file in the object that used it last.
  struct NormalUse
  {
    std::uint32_t object = 0;
    std::int32_t normal = -1;
  };
  /// How many came before the current statement.
  struct Counts
  {
    std::size_t vertices = 0;
    std::size_t uvs = 0;
    std::size_t normals = 0;
  };

  std::string Path;
  ObjStatements Statements;
  ObjValues Values;
  std::vector<std::uint32_t> SamePlace; ///< vertex of the file -> the first one at its place
  std::vector<std::uint32_t> VertexOf;  ///< vertex of the file -> of the builder, in the object that used it last
  std::vector<std::uint32_t> PlaceOf;   ///< vertex of the builder -> of the file
  std::vector<NormalUse> NormalOf;
  std::uint64_t MostBytes;
  std::uint64_t ObjectBytes = 0;
  ModelBuilder Builder;
  ObjMaterials Materials;
  std::string Name = "defaultobject";
  std::string MaterialName;
  std::optional<int> Material; ///< made when a face uses it
  SurfaceStyle Style{ 0, Shading::Crease, 0, false };
  std::vector<Corner> Corners;
  Counts Before;
  bool InObject = false;
  bool HasUvs = false;
  std::uint32_t Objects = 0;
  std::size_t FirstVertex = 0; ///< of the builder, in the current object
  std::uint64_t Points = 0;
  std::uint64_t FreeForms = 0;
  std::uint64_t Calls = 0; ///< of other files and programs
  std::uint64_t Lost = 0;
};
} // namespace

ModelContents readObj(const std::string& path, const ReadOptions& options);
ModelContents readObj(const std::string& path, const ReadOptions& options)
{
  std::string text = toUtf8(readFile(path));
  if (text.find('\n') == std::string::npos)
  {
    std::replace(text.begin(), text.end(), '\r', '\n');
  }
  return ObjAssembly(path, text, options).run();
}

} // namespace dgtk
