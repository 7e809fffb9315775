// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColladaSurvey.h"

#include <cstdlib>

namespace dgtk::import
{

int setOf(const std::string& written)
{
  const bool isNumber = !written.empty() && written.size() < 6 && written.find_first_not_of("0123456789") > 5;
  return isNumber ? std::atoi(written.c_str()) : -1;
}

std::string idOf(const std::string& reference) { return reference.substr(reference.rfind('#', 0) == 0 ? 1 : 0); }

ColladaSurvey::ColladaSurvey(const std::string& xml)
{
  forEachMarkup(xml,
    [&](std::size_t begin, std::size_t end, const Markup& markup)
    {
      if (markup.isEnd() && markup.isOf("Name_array"))
      {
        const std::string names = xml.substr(begin, end - begin);
        for (const char* const curve : { "STEP", "BEZIER", "HERMITE", "CARDINAL", "BSPLINE" })
        {
          this->HasCurves = this->HasCurves || (this->IsAnimation && names.find(curve) != std::string::npos);
        }
      }
      this->lookAt(markup);
    });
  this->bind();
  this->warnOf();
}

void ColladaSurvey::lookAt(const Markup& markup)
{
  if (markup.isOf("extra") && !markup.isEmpty())
  {
    this->Extras += markup.isEnd() ? -1 : 1;
  }
  if (this->Extras > 0) // where anything may stand
  {
    return;
  }
  if (markup.begins("node"))
  {
    this->lookAtNode(markup);
  }
  else if (markup.begins("animation_clip"))
  {
    this->hasClips = true;
  }
  else if (markup.begins("morph"))
  {
    this->problem = "morph controllers are not read";
  }
  else if (markup.begins("h"))
  {
    this->problem = "polygons with holes (<ph>) are not read: export triangles";
  }
  else if (markup.begins("skew"))
  {
    this->problem = "skewed nodes are not read: give them matrices";
  }
  if (markup.isOf("library_animations"))
  {
    this->IsAnimation = !markup.isEnd() && !markup.isEmpty();
  }
  this->HasSkins = this->HasSkins || markup.begins("instance_controller");
  this->lookAtCoordinates(markup);
}

void ColladaSurvey::lookAtNode(const Markup& node)
{
  this->nodes.insert(node.attribute("id"));
  const std::string sid = node.attribute("type") == "JOINT" ? node.attribute("sid") : std::string();
  this->HasTwins = (!sid.empty() && !this->joints.insert(sid).second) || this->HasTwins;
}

void ColladaSurvey::lookAtCoordinates(const Markup& markup)
{
  // elements whose pictures are drawn: they lie where the first one's does
  static const std::map<std::string, int> drawn{ { "diffuse", 0 }, { "emission", 1 }, { "transparent", 2 } };
  const auto element =
    std::find_if(drawn.begin(), drawn.end(), [&markup](const auto& entry) { return markup.isOf(entry.first); });
  if (element != drawn.end())
  {
    this->Element = markup.isEnd() || markup.isEmpty() ? -1 : element->second;
  }
  else if (markup.isOf("effect"))
  {
    for (const auto& [rank, channel] : this->Pictures)
    {
      (rank == this->Pictures.begin()->first ? this->Drawn : this->Beside).insert(channel);
    }
    this->Pictures.clear();
  }
  else if (markup.isEnd())
  {
    return;
  }
  else if (markup.isOf("geometry"))
  {
    this->Geometry = markup.attribute("id");
  }
  else if (markup.isOf("controller"))
  {
    this->Controller = markup.attribute("id");
  }
  else if (markup.isOf("skin"))
  {
    this->Skinned[this->Controller] = idOf(markup.attribute("source"));
  }
  else if (markup.isOf("instance_geometry") || markup.isOf("instance_controller"))
  {
    this->Instance = idOf(markup.attribute("url"));
  }
  else if (markup.isOf("instance_material"))
  {
    this->Symbol = markup.attribute("symbol");
  }
  else if (markup.isOf("texture") && this->Element >= 0)
  {
    this->Pictures[this->Element] = markup.attribute("texcoord");
  }
  else if (markup.isOf("input") && markup.attribute("semantic") == "TEXCOORD")
  {
    this->sets[this->Geometry].insert(std::max(setOf(markup.attribute("set")), 0));
  }
  else if (markup.isOf("bind_vertex_input") && markup.attribute("input_semantic") == "TEXCOORD")
  {
    constexpr std::size_t longest = 4096; // a copy for each binding
    const int set = setOf(markup.attribute("input_set"));
    if (this->Instance.size() + this->Symbol.size() < longest)
    {
      this->Bindings.push_back({ this->Instance, this->Symbol, markup.attribute("semantic"), set });
    }
  }
}

void ColladaSurvey::bind()
{
  std::map<std::pair<std::string, std::string>, std::set<int>> beside;
  for (const Binding& binding : this->Bindings)
  {
    const auto skinned = this->Skinned.find(binding.instance);
    const std::string& geometry = skinned == this->Skinned.end() ? binding.instance : skinned->second;
    const bool isBeside = this->Drawn.count(binding.channel) == 0;
    if ((isBeside && this->Beside.count(binding.channel) == 0) || this->sets[geometry].count(binding.set) == 0)
    {
      continue;
    }
    (isBeside ? beside : this->bound)[{ geometry, binding.symbol }].insert(binding.set);
    if (!isBeside)
    {
      this->channels.insert(binding.channel);
    }
  }
  this->HasSeveral =
    std::any_of(this->bound.begin(), this->bound.end(), [](const auto& row) { return row.second.size() > 1; }) ||
    std::any_of(beside.begin(), beside.end(),
      [this](const auto& row)
      {
        const auto first = this->bound.find(row.first);
        return first != this->bound.end() && first->second != row.second;
      });
}

void ColladaSurvey::warnOf()
{
  if (this->HasSeveral)
  {
    this->warnings.emplace_back("materials bind their pictures to several sets of texture coordinates: one is drawn");
  }
  if (this->HasCurves)
  {
    this->warnings.emplace_back("steps and curves between keys of animations are played as straight lines");
  }
  if (this->HasTwins && this->HasSkins)
  {
    this->warnings.emplace_back("several joints have the same sid: skins follow the first one");
  }
}

} // namespace dgtk::import
