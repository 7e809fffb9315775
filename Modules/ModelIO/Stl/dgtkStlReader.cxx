// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkByteReader.h"
#include "dgtkEqualItems.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelBuilder.h"
#include "dgtkTextLines.h"

#include <algorithm>
#include <cctype>

namespace dgtk
{

namespace
{
constexpr std::size_t headerBytes = 84;
constexpr std::size_t facetBytes = 50;

/// A solid of the file: three positions a triangle.
struct Solid
{
  std::string name;
  std::vector<Eigen::Vector3d> corners;
};

/// Whether a word, of any case, is `known`, in lower case.
bool is(std::string_view word, std::string_view known)
{
  return word.size() == known.size() && std::equal(word.begin(), word.end(), known.begin(),
                                          [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

/// Headers of binary files may say "solid", too. Their length is that of their count of triangles, or they have a zero
/// and no facet's word.
bool isText(const std::string& path, const std::string& bytes)
{
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string::npos || !is(std::string_view(bytes).substr(start, 5), "solid"))
  {
    return false;
  }
  if (bytes.size() >= headerBytes)
  {
    const std::uint64_t facets = ByteReader(path, bytes).u32(headerBytes - 4);
    if (bytes.size() == headerBytes + facets * facetBytes)
    {
      return false;
    }
  }
  constexpr std::string_view word = "facet";
  return bytes.find('\0') == std::string::npos ||
         std::search(bytes.begin(), bytes.end(), word.begin(), word.end(),
           [](unsigned char a, unsigned char b) { return std::tolower(a) == b; }) != bytes.end();
}

Solid readBinary(const std::string& path, const std::string& bytes, bool& colored)
{
  const ByteReader in(path, bytes);
  in.need(0, headerBytes, "the header");
  const std::uint64_t facets = in.u32(headerBytes - 4);
  in.need(headerBytes, facets * facetBytes, "triangles");
  colored = bytes.find("COLOR=") < headerBytes - 4;
  Solid solid;
  solid.corners.reserve(facets * 3);
  for (std::size_t i = 0; i < facets; ++i)
  {
    const std::size_t at = headerBytes + i * facetBytes;
    for (std::size_t corner = at + 12; corner < at + 48; corner += 12) // behind the normal
    {
      solid.corners.emplace_back(double(in.f32(corner)), double(in.f32(corner + 4)), double(in.f32(corner + 8)));
    }
    colored = colored || (in.u16(at + 48) & 0x8000u) != 0;
  }
  return solid;
}

/// The words of the text, with their lines.
class StlWords
{
public:
  StlWords(const std::string& path, const std::string& text)
    : Path(path)
    , Text(text)
  {
  }
  /// The next word; empty at the end.
  std::string_view next()
  {
    while (this->At < this->Text.size() && std::isspace(static_cast<unsigned char>(this->Text[this->At])) != 0)
    {
      const char c = this->Text[this->At++];
      this->Line += c == '\n' || (c == '\r' && this->Text.substr(this->At, 1) != "\n") ? 1 : 0;
    }
    const std::size_t begin = this->At;
    while (this->At < this->Text.size() && std::isspace(static_cast<unsigned char>(this->Text[this->At])) == 0)
    {
      ++this->At;
    }
    return this->Text.substr(begin, this->At - begin);
  }
  /// What is left of the line, without blanks at both ends.
  std::string_view restOfLine()
  {
    const std::size_t end = std::min(this->Text.find_first_of("\r\n", this->At), this->Text.size());
    std::string_view rest = this->Text.substr(this->At, end - this->At);
    this->At = end;
    const std::size_t first = rest.find_first_not_of(" \t");
    const std::size_t last = rest.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string_view() : rest.substr(first, last - first + 1);
  }
  double number()
  {
    const std::string_view word = this->next();
    const std::optional<double> value = parseNumber(word);
    if (!value)
    {
      this->refuse("a number", word);
    }
    return *value;
  }
  [[noreturn]] void refuse(const char* expected, std::string_view found) const
  {
    throw InputError(this->Path, this->Line, found.empty() ? "ends too soon" : "is no STL file", expected,
      found.empty() ? "end of file" : quoted(std::string(found.substr(0, 60))));
  }

private:
  const std::string& Path;
  std::string_view Text;
  std::size_t At = 0;
  long Line = 1;
};

/// One facet, behind its first word; a polygon of more than three vertices is a fan.
void readFacet(StlWords& words, std::vector<Eigen::Vector3d>& corners)
{
  std::vector<Eigen::Vector3d> loop;
  bool isNormal = false; // its words go on until the vertices', which are what counts
  for (std::string_view word = words.next(); !is(word, "endfacet"); word = words.next())
  {
    const bool isNext = is(word, "vertex") || is(word, "outer");
    isNormal = (isNormal || is(word, "normal")) && !isNext && !word.empty();
    if (is(word, "vertex"))
    {
      const double x = words.number();
      const double y = words.number();
      loop.emplace_back(x, y, words.number());
    }
    else if (!isNext && !isNormal && !is(word, "loop") && !is(word, "endloop"))
    {
      words.refuse("vertex or endfacet", word);
    }
  }
  for (std::size_t i = 2; i < loop.size(); ++i)
  {
    corners.insert(corners.end(), { loop[0], loop[i - 1], loop[i] });
  }
}

std::vector<Solid> readText(const std::string& path, const std::string& text)
{
  StlWords words(path, text);
  std::vector<Solid> solids;
  bool open = false;
  for (std::string_view word = words.next(); open || !word.empty(); word = words.next())
  {
    if (is(word, open ? "endsolid" : "solid"))
    {
      const std::string name(words.restOfLine());
      open = !open;
      if (open)
      {
        solids.push_back({ name, {} });
      }
    }
    else if (open && is(word, "facet"))
    {
      readFacet(words, solids.back().corners);
    }
    else
    {
      words.refuse(open ? "facet or endsolid" : "solid", word);
    }
  }
  return solids;
}

void addSolid(ModelBuilder& builder, const Solid& solid)
{
  builder.beginObject(solid.name);
  const std::vector<std::uint32_t> first = firstOfEqualPoints(
    solid.corners.size(), [&solid](std::size_t i) -> const Eigen::Vector3d& { return solid.corners[i]; });
  std::vector<std::uint32_t> vertices(first.size());
  builder.reserve(0, first.size() / 3, first.size());
  SurfaceStyle style;
  style.material = builder.defaultMaterial();
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    vertices[i] = first[i] == i ? builder.addVertex(solid.corners[i]) : vertices[first[i]];
    if (i % 3 == 2)
    {
      const Corner corners[3] = { { vertices[i - 2], -1, 0, 0 }, { vertices[i - 1], -1, 0, 0 },
        { vertices[i], -1, 0, 0 } };
      builder.addSurface(corners, 3, style);
    }
  }
  builder.endObject();
}
} // namespace

ModelContents readStl(const std::string& path, const ReadOptions& options);
ModelContents readStl(const std::string& path, const ReadOptions& options)
{
  std::string bytes = readFile(path);
  constexpr std::string_view mark = "\xef\xbb\xbf"; // of a text's byte order
  if (bytes.compare(0, mark.size(), mark) == 0 && isText(path, bytes.substr(mark.size())))
  {
    bytes.erase(0, mark.size());
  }
  ModelBuilder builder(path, "stl", bytes.size(), options);
  builder.model().isNumbered = false;
  bool colored = false;
  if (isText(path, bytes))
  {
    for (const Solid& solid : readText(path, bytes))
    {
      addSolid(builder, solid);
    }
  }
  else
  {
    addSolid(builder, readBinary(path, bytes, colored));
  }
  if (colored)
  {
    builder.warn("colours of triangles are not drawn");
  }
  builder.keep({}, ModelContents::worthwhile);
  return builder.finish();
}

} // namespace dgtk
