// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlyHeader.h"

#include "dgtkError.h"
#include "dgtkModelBuilder.h"
#include "dgtkTextLines.h"

#include <algorithm>
#include <charconv>
#include <map>

namespace dgtk
{

namespace
{
constexpr std::size_t mostElements = 64;
constexpr std::size_t mostProperties = 256;
constexpr std::size_t longestHeader = 1 << 20;

const std::map<std::string, PlyType>& types()
{
  static const std::map<std::string, PlyType> known = { { "char", PlyType::Int8 }, { "int8", PlyType::Int8 },
    { "uchar", PlyType::UInt8 }, { "uint8", PlyType::UInt8 }, { "short", PlyType::Int16 }, { "int16", PlyType::Int16 },
    { "ushort", PlyType::UInt16 }, { "uint16", PlyType::UInt16 }, { "int", PlyType::Int32 },
    { "int32", PlyType::Int32 }, { "uint", PlyType::UInt32 }, { "uint32", PlyType::UInt32 },
    { "float", PlyType::Float32 }, { "float32", PlyType::Float32 }, { "double", PlyType::Float64 },
    { "float64", PlyType::Float64 } };
  return known;
}

TextureWrap wrapOf(const std::string& word)
{
  return word == "clamp" ? TextureWrap::Clamp : word == "mirror" ? TextureWrap::Mirror : TextureWrap::Repeat;
}

class HeaderParser
{
public:
  HeaderParser(const std::string& path, const std::string& contents)
    : Path(path)
    , Contents(contents)
    , Lines(contents)
  {
  }

  PlyHeader run()
  {
    if (!this->nextLine() || this->Words.size() != 1 || this->Words[0] != "ply")
    {
      this->fail("is not a PLY file", "ply", this->Words.empty() ? "nothing" : quoted(this->Words[0]));
    }
    while (this->nextLine())
    {
      if (!this->Words.empty() && this->Words[0] == "end_header")
      {
        this->finish();
        return this->Header;
      }
      this->line();
    }
    this->fail("header ends too soon", "end_header", "end of file");
  }

private:
  [[noreturn]] void fail(const std::string& what, const std::string& expected, const std::string& found)
  {
    throw InputError(this->Path, std::max(this->Lines.lineNumber(), 1L), what, expected, found);
  }

  std::size_t at() const { return this->Contents.size() - this->Lines.remaining(); }

  bool nextLine()
  {
    this->Words.clear();
    if (this->at() >= longestHeader || !this->Lines.next())
    {
      return false;
    }
    this->Text = this->Lines.line().substr(0, 4096);
    this->Words.assign(this->Lines.words().begin(), this->Lines.words().end());
    return true;
  }

  void line()
  {
    if (this->Words.empty() || this->Words[0] == "obj_info")
    {
      return;
    }
    const std::string& word = this->Words[0];
    if (word == "comment")
    {
      std::vector<PlyPicture>& pictures = this->Header.pictures;
      if (this->Words.size() > 2 && this->Words[1] == "TextureFile")
      {
        // a name may have blanks in it
        const std::size_t at = this->Text.find(this->Words[2], this->Text.find("TextureFile") + 11);
        const std::size_t end = this->Text.find_last_not_of(" \t\r") + 1;
        pictures.push_back({ this->Words.size() == 3 ? this->Words[2] : this->Text.substr(at, end - at), {} });
      }
      else if (this->Words.size() == 4 && this->Words[1] == "TextureWrap" && !pictures.empty())
      {
        pictures.back().wrap = { wrapOf(this->Words[2]), wrapOf(this->Words[3]) };
      }
    }
    else if (word == "format")
    {
      this->format();
    }
    else if (word == "element")
    {
      this->element();
    }
    else if (word == "property")
    {
      this->property();
    }
    else
    {
      this->fail("unknown line in the header", "format, element, property, comment or end_header", quoted(word));
    }
  }

  void format()
  {
    const std::string name = this->Words.size() > 1 ? this->Words[1] : "";
    if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
    {
      this->fail("unknown format", "ascii, binary_little_endian or binary_big_endian", quoted(name));
    }
    this->Header.encoding = name == "ascii"                  ? PlyHeader::Encoding::Ascii
                            : name == "binary_little_endian" ? PlyHeader::Encoding::Little
                                                             : PlyHeader::Encoding::Big;
    this->HasFormat = true;
  }

  void element()
  {
    PlyElement element;
    const std::string count = this->Words.size() == 3 ? this->Words[2] : "";
    const auto parsed = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty() || parsed.ec != std::errc() || parsed.ptr != count.data() + count.size())
    {
      this->fail("element has no count", "element NAME COUNT", quoted(this->Text));
    }
    element.name = this->Words[1];
    for (const PlyElement& other : this->Header.elements)
    {
      if (other.name == element.name)
      {
        this->fail("element declared twice", "another name", quoted(element.name));
      }
    }
    if (this->Header.elements.size() >= mostElements)
    {
      this->fail("too many elements", "at most " + std::to_string(mostElements), "more");
    }
    this->Header.elements.push_back(element);
  }

  PlyType type(const std::string& name)
  {
    const auto found = types().find(name);
    if (found == types().end())
    {
      this->fail("unknown type", "char, uchar, short, ushort, int, uint, float or double", quoted(name));
    }
    return found->second;
  }

  void property()
  {
    if (this->Header.elements.empty())
    {
      this->fail("property before any element", "element", "property");
    }
    std::vector<PlyProperty>& properties = this->Header.elements.back().properties;
    PlyProperty property;
    property.isList = this->Words.size() > 1 && this->Words[1] == "list";
    if (this->Words.size() != (property.isList ? 5u : 3u) || properties.size() >= mostProperties)
    {
      this->fail("property cannot be understood", "property [list COUNTTYPE] TYPE NAME", quoted(this->Text));
    }
    if (property.isList)
    {
      property.countType = this->type(this->Words[2]);
      if (property.countType == PlyType::Float32 || property.countType == PlyType::Float64)
      {
        this->fail("list counts must be whole numbers", "an integer type", quoted(this->Words[2]));
      }
    }
    property.type = this->type(this->Words[property.isList ? 3 : 1]);
    property.name = this->Words.back();
    properties.push_back(property);
  }

  /// No element can claim more than the bytes that follow can hold.
  void finish()
  {
    if (!this->HasFormat)
    {
      this->fail("header names no format", "format ascii 1.0", "none");
    }
    this->Header.bodyAt = this->at();
    std::uint64_t left = this->Lines.remaining();
    const bool ascii = this->Header.encoding == PlyHeader::Encoding::Ascii;
    for (const PlyElement& element : this->Header.elements)
    {
      std::uint64_t each = 0;
      for (const PlyProperty& property : element.properties)
      {
        each += ascii ? 2 : bytesOf(property.isList ? property.countType : property.type);
      }
      // the last number of a text needs no space after it
      if (element.count > 0 && (each == 0 || element.count > (left + 1) / each))
      {
        throw InputError(this->Path, "has fewer bytes than element " + quoted(element.name) + " needs",
          std::to_string(element.count) + " times at least " + std::to_string(each), std::to_string(left));
      }
      left -= std::min(left, element.count * each);
    }
  }

  const std::string& Path;
  const std::string& Contents;
  PlyHeader Header;
  TextLines Lines;
  std::string Text;
  std::vector<std::string> Words;
  bool HasFormat = false;
};
} // namespace

std::size_t bytesOf(PlyType type)
{
  static const std::size_t bytes[] = { 1, 1, 2, 2, 4, 4, 4, 8 };
  return bytes[static_cast<std::size_t>(type)];
}

int PlyElement::find(std::initializer_list<const char*> names) const
{
  for (const char* wanted : names)
  {
    for (std::size_t i = 0; i < this->properties.size(); ++i)
    {
      if (this->properties[i].name == wanted)
      {
        return static_cast<int>(i);
      }
    }
  }
  return -1;
}

PlyColor::PlyColor(const PlyElement& element)
  : Red(element.find({ "red", "diffuse_red", "r" }))
  , Green(element.find({ "green", "diffuse_green", "g" }))
  , Blue(element.find({ "blue", "diffuse_blue", "b" }))
  , Alpha(element.find({ "alpha", "diffuse_alpha", "a" }))
{
  const PlyType type = this->Red < 0 ? PlyType::Float32 : element.properties[static_cast<std::size_t>(this->Red)].type;
  const bool real = type == PlyType::Float32 || type == PlyType::Float64;
  this->White = real ? 1 : bytesOf(type) == 1 ? 255 : bytesOf(type) == 2 ? 65535 : 4294967295.0;
}

Eigen::Vector3d PlyColor::in(const std::vector<double>& row)
{
  const auto at = [&row](int property) { return PlyElement::valueAt(row, property); };
  const Eigen::Vector3d color(at(this->Red), at(this->Green), at(this->Blue));
  this->Most = std::max(this->Most, color.maxCoeff());
  return color / this->White;
}

std::string PlyColor::oddRange() const
{
  constexpr double rounding = 1e-3;
  if (this->White == 1)
  {
    return this->Most > 1 + rounding ? "colours above 1 are drawn as 1, which is white for numbers with fractions" : "";
  }
  return this->White > 255 && this->Most > 0 && this->Most <= 255
           ? "colours are all but black: white is " + std::to_string(std::uint64_t(this->White)) + " for their type"
           : "";
}

std::array<std::uint8_t, 4> PlyColor::bytesIn(const std::vector<double>& row)
{
  const double alpha = this->Alpha < 0 ? 1 : PlyElement::valueAt(row, this->Alpha) / this->White;
  return colorBytes(this->in(row).data(), alpha);
}

PlyHeader readPlyHeader(const std::string& path, const std::string& contents)
{
  return HeaderParser(path, contents).run();
}

} // namespace dgtk
