// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColladaText.h"

#include "dgtkColladaSurvey.h"
#include "dgtkColladaTurns.h"

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

/// All animations of a library in one, whose channels Assimp 5.2 joins by nodes: it has a sequence, or a channel that
/// replaces others of its node, of each. Clips name animations, which stay then.
class OneAnimation
{
public:
  explicit OneAnimation(const ColladaSurvey& survey)
    : HasClips(survey.hasClips)
  {
  }

  std::string tag(const Markup& markup, const std::string& tag)
  {
    if (this->HasClips || (!markup.isOf("animation") && !markup.isOf("library_animations")))
    {
      return tag;
    }
    if (markup.isOf("library_animations"))
    {
      return std::exchange(this->IsOpen, false) ? "</animation>" + tag : tag;
    }
    const bool isFirst = !this->IsOpen && !markup.isEnd() && !markup.isEmpty();
    this->IsOpen = this->IsOpen || isFirst;
    return isFirst ? tag : "";
  }

private:
  bool HasClips;
  bool IsOpen = false;
};

/// Version 1.5 as 1.4.1, of which Assimp 5.2 reads pictures, and names of files without an element of their own in
/// both.
std::string inOldWords(const Markup& markup, const std::string& tag, bool isInInit)
{
  const bool isNew = markup.begins("COLLADA") && markup.attribute("version").rfind("1.5", 0) == 0;
  return isNew ? markup.with("COLLADA", "version", "1.4.1") : markup.isOf("ref") && isInInit ? std::string() : tag;
}

/// Says in a picture's element what Assimp 5.2 does not find elsewhere: the image itself, whose id may be that of a
/// parameter, too; in Maya's words how its sampler goes on beyond it, unless the element says so; and whether its
/// values say how much is not there.
class Samplers
{
public:
  /// What to write instead of a tag; `text` is what stands before the markup.
  std::string tag(const std::string& text, const Markup& markup, const std::string& tag)
  {
    const bool isEnd = markup.isEnd();
    const bool isOver = isEnd || markup.isEmpty();
    if (markup.isOf("effect"))
    {
      this->Parameters.clear();
    }
    else if (markup.isOf("newparam"))
    {
      this->Sid = isOver ? std::string() : markup.attribute("sid");
      return isOver ? tag : markup.with("newparam", "sid", mark + this->Sid);
    }
    else if (!this->Sid.empty())
    {
      this->lookAt(text, markup);
    }
    else if (markup.isOf("transparent"))
    {
      const std::string opaque = isOver ? std::string() : markup.attribute("opaque");
      const bool isInverse = opaque == "A_ZERO" || opaque == "RGB_ZERO";
      this->Last = isInverse ? extra("<weighting>" + std::to_string(inverseWeight) + "</weighting>") : std::string();
    }
    else if (markup.isOf("texture"))
    {
      return isEnd ? this->Last + tag : this->texture(markup, tag);
    }
    return tag;
  }

private:
  static constexpr std::size_t longestName = 1000; ///< of what is written for each picture
  struct Parameter
  {
    std::string image; ///< its id, or:
    std::string surface;
    std::string wraps[2]; ///< along u and v
  };

  static std::string extra(const std::string& said)
  {
    return said.empty() ? said : R"(<extra><technique profile="MAYA">)" + said + "</technique></extra>";
  }

  void lookAt(const std::string& text, const Markup& markup)
  {
    Parameter& parameter = this->Parameters[this->Sid];
    if (markup.begins("instance_image"))
    {
      parameter.image = idOf(markup.attribute("url"));
    }
    else if (markup.isEnd() && markup.isOf("init_from"))
    {
      parameter.image = text;
    }
    else if (markup.isEnd() && markup.isOf("source"))
    {
      parameter.surface = text;
    }
    else if (markup.isEnd() && (markup.isOf("wrap_s") || markup.isOf("wrap_t")) && text != "WRAP")
    {
      const bool isMirror = text == "MIRROR";
      const std::string element = std::string(isMirror ? "mirror" : "wrap") + (markup.isOf("wrap_s") ? 'U' : 'V');
      parameter.wraps[markup.isOf("wrap_s") ? 0 : 1] = '<' + element + (isMirror ? ">1</" : ">0</") + element + '>';
    }
  }

  std::string texture(const Markup& markup, const std::string& tag) const
  {
    std::string name = markup.attribute("texture");
    std::string wraps;
    if (const auto sampler = this->Parameters.find(name); sampler != this->Parameters.end())
    {
      const auto surface = this->Parameters.find(sampler->second.surface);
      const bool hasSurface = sampler->second.image.empty() && surface != this->Parameters.end();
      const Parameter& named = hasSurface ? surface->second : sampler->second;
      const std::string& image = named.image.empty() ? sampler->second.surface : named.image;
      name = image.empty() || image.size() > longestName ? name : image;
      wraps = extra(sampler->second.wraps[0] + sampler->second.wraps[1]);
    }
    std::string to = Markup(tag, 0).with("texture", "texture", name);
    if (!markup.isEmpty())
    {
      return to + wraps;
    }
    to.erase(to.size() - 2);
    return to + '>' + wraps + this->Last + "</texture>";
  }

  std::map<std::string, Parameter> Parameters; ///< of an effect, by sid
  std::string Sid;                             ///< of the one that is open
  std::string Last;                            ///< what a picture's element ends with
};

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
  Samplers samplers;
  OneAnimation animations(survey);
  ColladaTurns turns(xml, mark);
  to.warnings.insert(to.warnings.end(), turns.warnings.begin(), turns.warnings.end());
  bool isInInit = false;
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
      to.text += turns.before(markup);
      meant = markup.begins("rotate") ? &rotation : markup.begins("lookat") ? &lookat : nullptr;
      if (markup.begins("node"))
      {
        to.text += turns.tag(markup, nodes.tag(markup));
      }
      else if (!markup.isOf("unit"))
      {
        const std::string tag = inOldWords(markup, withBlack(markup, coordinates.tag(markup)), isInInit);
        to.text += animations.tag(markup, turns.tag(markup, samplers.tag(xml.substr(begin, end - begin), markup, tag)));
        // it may be left out, and is 0 in Assimp 5.2; what the skin says comes later, and counts
        to.text += markup.begins("skin") && !markup.isEmpty()
                     ? "<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>"
                     : "";
        isInInit = markup.isOf("init_from") ? !markup.isEnd() && !markup.isEmpty() : isInInit;
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
