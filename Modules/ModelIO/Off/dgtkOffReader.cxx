// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEqualItems.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelBuilder.h"
#include "dgtkTextLines.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dgtk
{

namespace
{
/// The words of the text without its comments. A copy looks ahead.
class OffWords
{
public:
  OffWords(const std::string& path, const std::string& text)
    : Path(path)
    , Text(text)
  {
  }

  /// The next word of the line; empty at its end.
  std::string_view onLine()
  {
    const std::size_t begin = std::min(this->Text.find_first_not_of(" \t\f\v", this->At), this->Text.size());
    this->At = std::min(this->Text.find_first_of(" \t\f\v\r\n#", begin), this->Text.size());
    return this->Text.substr(begin, this->At - begin);
  }
  /// Passes by what is left of the line. Returns how many words.
  std::size_t skipLine()
  {
    std::size_t words = 0;
    while (!this->onLine().empty())
    {
      ++words;
    }
    return words;
  }
  /// False at the end of the text.
  bool nextLine()
  {
    const std::size_t end = std::min(this->Text.find_first_of("\r\n", this->At), this->Text.size());
    this->At = std::min(end + (this->Text.substr(end, 2) == "\r\n" ? 2 : 1), this->Text.size());
    this->Line += end < this->Text.size() ? 1 : 0;
    return this->At < this->Text.size();
  }
  /// The next word, on whatever line.
  std::string_view next(const char* expected)
  {
    std::string_view word = this->onLine();
    while (word.empty() && this->nextLine())
    {
      word = this->onLine();
    }
    if (word.empty())
    {
      this->refuse("ends too soon", expected, word);
    }
    return word;
  }
  std::size_t count()
  {
    const std::string_view word = this->next("a count");
    const std::optional<long long> value = parseInteger(word);
    if (!value || *value < 0)
    {
      this->refuse("is no OFF file", "a count", word);
    }
    return static_cast<std::size_t>(*value);
  }
  double number()
  {
    const std::string_view word = this->next("a number");
    const std::optional<double> value = parseNumber(word);
    if (!value)
    {
      this->refuse("is no OFF file", "a number", word);
    }
    return *value;
  }
  /// Words of the next line that has some.
  std::size_t wordsAhead() const
  {
    OffWords ahead = *this;
    ahead.next("a number");
    return 1 + ahead.skipLine();
  }
  /// Lines with words that are left.
  std::size_t linesAhead() const
  {
    OffWords ahead = *this;
    std::size_t lines = 0;
    do
    {
      lines += ahead.onLine().empty() ? 0 : 1;
    } while (ahead.nextLine());
    return lines;
  }

  [[noreturn]] void refuse(const char* what, const char* expected, std::string_view found) const
  {
    throw InputError(
      this->Path, this->Line, what, expected, found.empty() ? "end of file" : quoted(std::string(found.substr(0, 60))));
  }

private:
  const std::string& Path;
  std::string_view Text;
  std::size_t At = 0;
  long Line = 1;
};

/// What the file's first word says of its vertices (Geomview, OFF(5): [ST][C][N][4][n]OFF); in this order it stands
/// behind their coordinates, the other way round.
struct OffForm
{
  bool hasUvs = false;
  bool hasColors = false;
  bool hasNormals = false;
  bool isHomogeneous = false;
  std::size_t dimension = 3;
  std::size_t colorParts = 4;

  std::size_t numbers() const
  {
    return this->dimension + (this->isHomogeneous ? 1 : 0) + (this->hasNormals ? 3 : 0) +
           (this->hasColors ? this->colorParts : 0) + (this->hasUvs ? 2 : 0);
  }
};

bool takePrefix(std::string_view& word, std::string_view prefix)
{
  const bool has = word.substr(0, prefix.size()) == prefix;
  word.remove_prefix(has ? prefix.size() : 0);
  return has;
}

/// Reads the word, which may be missing, and the dimension, which it may announce.
OffForm readForm(OffWords& words)
{
  constexpr const char* name = "[ST][C][N][4][n]OFF";
  OffForm form;
  OffWords ahead = words;
  const std::string_view first = ahead.next(name);
  if (parseInteger(first))
  {
    return form;
  }
  words.next(name);
  std::string_view rest = first;
  form.hasUvs = takePrefix(rest, "ST");
  form.hasColors = takePrefix(rest, "C");
  form.hasNormals = takePrefix(rest, "N");
  form.isHomogeneous = takePrefix(rest, "4");
  const bool saysDimension = takePrefix(rest, "n");
  if (rest != "OFF")
  {
    words.refuse("is no OFF file", name, first);
  }
  const std::string_view second = ahead.next("a count");
  if (second == "BINARY")
  {
    words.refuse("is binary, which is not read", "text", second);
  }
  form.dimension = saysDimension ? words.count() : 3;
  if (form.dimension < 1 || form.dimension > 3)
  {
    words.refuse("has vertices of another dimension", "1 to 3", std::to_string(form.dimension));
  }
  return form;
}

class OffAssembly
{
public:
  OffAssembly(const std::string& path, const std::string& text, const ReadOptions& options)
    : Words(path, text)
    , Form(readForm(this->Words))
    , Builder(path, "off", text.size(), options)
  {
  }

  ModelContents run()
  {
    const std::size_t vertices = this->Words.count();
    const std::size_t faces = this->Words.count();
    if (this->Words.onLine().empty() && vertices > 0 && this->Form.numbers() > 1 && this->Words.wordsAhead() == 1)
    {
      this->Words.count(); // of edges, which may be missing
    }
    this->Builder.beginObject("");
    this->readVertices(vertices, faces);
    this->addVertices();
    for (std::size_t i = 0; i < faces; ++i)
    {
      this->readFace();
    }
    this->Builder.endObject();
    this->warn();
    this->Builder.keep({}, ModelContents::worthwhile);
    ModelContents contents = this->Builder.finish();
    setSourceOf(*contents.model, std::move(this->VertexOf));
    return contents;
  }

private:
  void readVertices(std::size_t vertices, std::size_t faces)
  {
    const std::size_t onLine = vertices > 0 ? this->Words.wordsAhead() : 0;
    this->Form.colorParts = this->Form.hasColors && onLine + 1 == this->Form.numbers() ? 3 : 4;
    // files may have more in a line than they say
    const bool hasMore = onLine > this->Form.numbers() && this->Words.linesAhead() >= vertices + faces;
    for (std::size_t i = 0; i < vertices; ++i)
    {
      this->readVertex();
      if (hasMore)
      {
        this->Words.skipLine();
      }
    }
  }

  void readVertex()
  {
    const auto next = [this] { return this->Words.number(); };
    Eigen::Vector3d position(0, 0, 0);
    std::generate_n(position.data(), this->Form.dimension, next);
    const double w = this->Form.isHomogeneous ? next() : 1;
    this->Positions.emplace_back(w != 0 ? Eigen::Vector3d(position / w) : position);
    if (this->Form.hasNormals)
    {
      Eigen::Vector3d normal;
      std::generate_n(normal.data(), 3, next);
      this->Normals.push_back(this->Builder.addNormal(normal));
    }
    for (std::size_t i = 0; this->Form.hasColors && i < this->Form.colorParts; ++i)
    {
      next();
    }
    if (this->Form.hasUvs)
    {
      std::generate_n(this->Uvs.emplace_back().data(), 2, next);
    }
  }

  /// Vertices at one place are one.
  void addVertices()
  {
    const std::vector<std::uint32_t> first = firstOfEqualPoints(
      this->Positions.size(), [this](std::size_t i) -> const Eigen::Vector3d& { return this->Positions[i]; });
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      this->VertexOf.push_back(first[i] == i ? this->Builder.addVertex(this->Positions[i]) : this->VertexOf[first[i]]);
    }
    this->Style.material = this->Builder.defaultMaterial();
  }

  Corner corner(std::size_t index) const
  {
    Corner corner;
    corner.vertex = 0xffffffffu;
    if (index < this->VertexOf.size())
    {
      corner.vertex = this->VertexOf[index];
      corner.normal = this->Form.hasNormals ? this->Normals[index] : -1;
      corner.u = this->Form.hasUvs ? static_cast<float>(this->Uvs[index][0]) : 0;
      corner.v = this->Form.hasUvs ? static_cast<float>(this->Uvs[index][1]) : 0;
    }
    return corner;
  }

  /// What is left of its line is its colour.
  void readFace()
  {
    this->Corners.clear();
    for (std::size_t left = this->Words.count(); left > 0; --left)
    {
      this->Corners.push_back(this->corner(this->Words.count()));
    }
    this->HasColors = this->Words.skipLine() > 0 || this->HasColors;
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
      this->Builder.addSurface(this->Corners, this->Style);
    }
  }

  void warn()
  {
    if (this->Form.hasUvs)
    {
      this->Builder.setHasUvs();
    }
    if (this->Form.hasColors)
    {
      this->Builder.warn("colours of vertices are not drawn");
    }
    if (this->HasColors)
    {
      this->Builder.warn("colours of faces are not drawn");
    }
    if (this->Points > 0)
    {
      this->Builder.warn(
        std::to_string(this->Points) + (this->Points == 1 ? " point is" : " points are") + " not drawn");
    }
  }

  OffWords Words;
  OffForm Form;
  ModelBuilder Builder;
  std::vector<Eigen::Vector3d> Positions;
  std::vector<std::int32_t> Normals; ///< of the builder, one a vertex of the file, or none
  std::vector<std::array<double, 2>> Uvs;
  std::vector<std::uint32_t> VertexOf; ///< vertex of the file -> of the model
  SurfaceStyle Style{ 0, Shading::Crease, 0, false };
  std::vector<Corner> Corners; ///< of the face that is read
  std::size_t Points = 0;
  bool HasColors = false; ///< of faces
};
} // namespace

ModelContents readOff(const std::string& path, const ReadOptions& options);
ModelContents readOff(const std::string& path, const ReadOptions& options)
{
  const std::string text = toUtf8(readFile(path));
  return OffAssembly(path, text, options).run();
}

} // namespace dgtk
