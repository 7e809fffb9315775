// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColladaText.h"

#include "dgtkColladaSurvey.h"

#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

namespace dgtk::import
{

namespace
{
/// Begins what is written before the names of nodes; no XML has it.
constexpr char mark = '\1';
/// Axes of as many digits as exporters write are left as they are.
constexpr double enough = 1e-5;

/// Names pictures of which the file says nothing, as it may: Assimp 5.2 refuses it for them.
class PictureNames
{
public:
  /// What to write before a markup of the file.
  std::string before(const Markup& markup)
  {
    const bool isImage = markup.isOf("image");
    if (isImage && !markup.isEnd())
    {
      const std::string id = markup.attribute("id");
      this->Name = id.empty() ? "?" : id;
      this->IsMissing = true;
      return {};
    }
    this->IsMissing = this->IsMissing && !markup.isOf("init_from") && !markup.isOf("data");
    return isImage && std::exchange(this->IsMissing, false) ? "<init_from>" + this->Name + "</init_from>" : "";
  }

private:
  bool IsMissing = false;
  std::string Name;
};

/// Gives nodes names by which Assimp 5.2 tells them apart when it looks for joints and for what moves. The first of
/// several nodes of one name keeps it: files name joints so.
class NodeNames
{
public:
  explicit NodeNames(const ColladaSurvey& survey)
    : Survey(survey)
  {
  }

  std::string tag(const Markup& node)
  {
    const std::string name = node.attribute("name");
    const std::string id = node.attribute("id");
    const bool isOther = (name != id && this->Survey.nodes.count(name) > 0) ||
                         (name != node.attribute("sid") && this->Survey.joints.count(name) > 0);
    if (!name.empty() && !isOther && this->Used.insert(name).second)
    {
      return node.text();
    }
    const std::string own = mark + std::to_string(this->Count++) + ':';
    const std::string named = node.with("node", "name", own + name);
    return id.empty() ? Markup(named, 0).with("node", "id", own) : named;
  }

private:
  const ColladaSurvey& Survey;
  std::set<std::string> Used;
  std::size_t Count = 0;
};

/// The set of texture coordinates that a geometry's material is bound to becomes the first one, which Assimp 5.2 takes
/// unless the name that the effect gives it has a number.
class Coordinates
{
public:
  explicit Coordinates(const ColladaSurvey& survey)
    : Survey(survey)
  {
  }

  std::string tag(const Markup& markup)
  {
    if (markup.isEnd())
    {
      return markup.text();
    }
    if (markup.isOf("texture"))
    {
      const bool isBound = this->Survey.channels.count(markup.attribute("texcoord")) > 0;
      return isBound ? markup.with("texture", "texcoord", "UV") : markup.text();
    }
    if (markup.isOf("input") && markup.attribute("semantic") == "TEXCOORD")
    {
      return this->input(markup);
    }
    if (markup.isOf("geometry"))
    {
      this->Geometry = markup.attribute("id");
    }
    for (const char* const primitive : { "triangles", "polylist", "polygons", "tristrips", "trifans" })
    {
      if (markup.isOf(primitive))
      {
        this->Symbol = markup.attribute("material");
      }
    }
    return markup.text();
  }

private:
  std::string input(const Markup& markup) const
  {
    const auto bound = this->Survey.bound.find({ this->Geometry, this->Symbol });
    if (bound == this->Survey.bound.end())
    {
      return markup.text();
    }
    const int wanted = *bound->second.begin();
    const int first = *this->Survey.sets.at(this->Geometry).begin();
    const int set = std::max(setOf(markup.attribute("set")), 0);
    const int other = set == wanted ? first : set == first ? wanted : set;
    return other == set ? markup.text() : markup.with("input", "set", std::to_string(other));
  }

  const ColladaSurvey& Survey;
  std::string Geometry;
  std::string Symbol;
};

using Vector = std::array<double, 3>;

/// False when it has no length.
bool normalize(Vector& v)
{
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const bool isGood = length > 0 && std::isfinite(length);
  for (double& number : v)
  {
    number /= isGood ? length : 1;
  }
  return isGood;
}

template <std::size_t N>
bool read(const std::string& text, std::array<double, N>& numbers)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  return std::all_of(numbers.begin(), numbers.end(), [&in](double& number) { return bool(in >> number); });
}

template <std::size_t N>
std::string written(const std::array<double, N>& numbers)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  for (const double number : numbers)
  {
    out << number << ' ';
  }
  return out.str();
}

/// The text of a rotate element about an axis of length 1.
std::string rotation(const std::string& text)
{
  std::array<double, 4> numbers{};
  const bool isGood = read(text, numbers);
  Vector axis{ numbers[0], numbers[1], numbers[2] };
  const double square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  if (!isGood || std::abs(square - 1) < 2 * enough || !normalize(axis))
  {
    return text;
  }
  std::copy(axis.begin(), axis.end(), numbers.begin());
  return written(numbers);
}

/// The text of a lookat element (eye, point, up) whose last vector is perpendicular to the view.
std::string lookat(const std::string& text)
{
  std::array<double, 9> n{};
  const bool isGood = read(text, n);
  Vector view{ n[3] - n[0], n[4] - n[1], n[5] - n[2] };
  Vector up{ n[6], n[7], n[8] };
  if (!isGood || !normalize(view) || !normalize(up))
  {
    return text;
  }
  const double along = view[0] * up[0] + view[1] * up[1] + view[2] * up[2];
  if (std::abs(along) < enough || std::abs(along) > 1 - enough)
  {
    return text;
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    n[6 + i] = up[i] - along * view[i];
  }
  return written(n);
}

/// A tag, and black behind it for what a shading model may leave out: Assimp 5.2 has greys of its own. What the model
/// says comes later, and counts.
std::string withBlack(const Markup& markup, std::string tag)
{
  const auto black = [](const std::string& part) { return '<' + part + "><color>0 0 0 1</color></" + part + '>'; };
  for (const std::string model : { "constant", "lambert", "phong", "blinn" })
  {
    if (markup.begins(model))
    {
      tag.erase(tag.size() - (markup.isEmpty() ? 2 : 1));
      tag += '>' + black("ambient") + black("specular") + (model == "constant" ? black("diffuse") : "");
      return markup.isEmpty() ? tag + "</" + model + '>' : tag;
    }
  }
  return tag;
}
} // namespace

ColladaText colladaText(const std::string& xml)
{
  const ColladaSurvey survey(xml);
  ColladaText to;
  to.problem = survey.problem;
  to.warnings = survey.warnings;
  to.text.reserve(xml.size());
  PictureNames pictures;
  NodeNames nodes(survey);
  Coordinates coordinates(survey);
  std::string (*meant)(const std::string&) = nullptr; // of the text behind the last markup
  forEachMarkup(xml,
    [&](std::size_t begin, std::size_t end, const Markup& markup)
    {
      if (meant)
      {
        to.text += meant(xml.substr(begin, end - begin));
      }
      else
      {
        to.text.append(xml, begin, end - begin);
      }
      to.text += pictures.before(markup);
      meant = markup.begins("rotate") ? &rotation : markup.begins("lookat") ? &lookat : nullptr;
      if (markup.begins("node"))
      {
        to.text += nodes.tag(markup);
      }
      else if (!markup.isOf("unit"))
      {
        to.text += withBlack(markup, coordinates.tag(markup));
      }
    });
  return to;
}

void restoreNames(Scene& scene)
{
  std::size_t unnamed = 0;
  for (Node& node : scene.nodes)
  {
    if (!node.name.empty() && node.name[0] == mark)
    {
      node.name.erase(0, node.name.find(':') + 1);
      node.name = node.name.empty() ? "$ColladaAutoName$_" + std::to_string(unnamed++) : node.name;
    }
  }
}

} // namespace dgtk::import
