// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColladaTurns.h"

#include "dgtkColladaSurvey.h"

namespace dgtk::import
{

namespace
{
constexpr std::size_t longestId = 1000; // of what is written for each turn

/// The kind of a transform that begins, or "".
std::string transformOf(const Markup& markup)
{
  for (const char* const kind : { "rotate", "translate", "scale", "matrix", "lookat" })
  {
    if (markup.begins(kind))
    {
      return kind;
    }
  }
  return {};
}

/// Of a channel's target, `node/sid`, which a member of its may follow.
std::size_t slashOf(const std::string& target) { return std::min(target.find('/'), target.size()); }

std::string sidOf(const std::string& target)
{
  const std::size_t begin = std::min(slashOf(target) + 1, target.size());
  return target.substr(begin, target.find_first_of(".(", begin) - begin);
}

/// What a node draws or has in it begins, or the node ends.
bool isContent(const Markup& markup)
{
  return markup.isOf("node") || markup.begins("instance_geometry") || markup.begins("instance_controller") ||
         markup.begins("instance_node");
}
} // namespace

ColladaTurns::ColladaTurns(const std::string& xml, char mark)
  : Mark(mark)
{
  forEachMarkup(xml, [this](std::size_t, std::size_t, const Markup& markup) { this->lookAt(markup); });
  for (auto& [id, node] : this->Nodes)
  {
    this->divide(id, node);
  }
  this->Stack.clear();
  this->Extras = 0;
}

bool ColladaTurns::isAside(const Markup& markup)
{
  if (markup.isOf("extra") && !markup.isEmpty())
  {
    this->Extras += markup.isEnd() ? -1 : 1;
  }
  return this->Extras > 0;
}

void ColladaTurns::lookAt(const Markup& markup)
{
  if (this->isAside(markup))
  {
    return;
  }
  if (!this->Stack.empty() && isContent(markup))
  {
    this->Stack.back().hasContent = true;
  }
  if (markup.begins("node"))
  {
    const std::string id = markup.attribute("id");
    Node& node = this->Nodes[id];
    ++node.tags;
    node.isOfLibrary = this->IsLibrary;
    if (!markup.isEmpty())
    {
      this->Stack.push_back({ &node, id, {} });
    }
  }
  else if (markup.isOf("node") && !this->Stack.empty())
  {
    this->Stack.pop_back();
  }
  else if (markup.isOf("library_nodes"))
  {
    this->IsLibrary = !markup.isEnd() && !markup.isEmpty();
  }
  else if (markup.begins("instance_node"))
  {
    this->Instanced.insert(import::idOf(markup.attribute("url")));
  }
  else if (markup.begins("channel"))
  {
    const std::string target = markup.attribute("target");
    const std::size_t slash = slashOf(target);
    this->Moving[target.substr(0, slash)].insert(sidOf(target));
  }
  else if (const std::string kind = transformOf(markup); !kind.empty() && !this->Stack.empty())
  {
    const Open& open = this->Stack.back();
    if (!open.id.empty()) // or nothing says that it moves
    {
      open.node->elements.push_back({ kind, markup.attribute("sid") });
      open.node->isMixed = open.node->isMixed || open.hasContent;
    }
  }
}

void ColladaTurns::divide(const std::string& id, Node& node)
{
  const auto moving = this->Moving.find(id);
  if (id.empty() || moving == this->Moving.end())
  {
    return;
  }
  std::size_t turns = 0;
  bool hasSize = false;
  bool isElsewhere = false; // than at a place, turned, with a size: in this order
  const Element* last = nullptr;
  bool isLastTurn = false;
  for (Element& element : node.elements)
  {
    const bool moves = !element.sid.empty() && moving->second.count(element.sid) > 0;
    const bool isTurn = element.kind == "rotate" && moves;
    turns += isTurn ? 1 : 0;
    isElsewhere = isElsewhere || (turns > 0 && (element.kind == "rotate" ? hasSize : element.kind != "scale"));
    hasSize = hasSize || element.kind == "scale" || element.kind == "matrix";
    element.piece = last ? last->piece + (isTurn || isLastTurn ? 1 : 0) : 0;
    if (moves)
    {
      node.pieces.emplace(element.sid, element.piece);
    }
    last = &element;
    isLastTurn = isTurn;
  }
  if (node.isOfLibrary)
  {
    if (!node.pieces.empty()) // Assimp moves nodes of the scene only
    {
      this->warn(id, " of library_nodes moves: its motion is not read");
    }
    return;
  }
  if (turns < 2 && !(turns == 1 && isElsewhere))
  {
    return;
  }
  if (node.tags > 1 || node.isMixed || id.size() > longestId || this->Instanced.count(id) > 0)
  {
    this->warn(id, " turns about a pivot or several axes: its way between keys is a straight line");
    return;
  }
  node.last = last->piece;
}

void ColladaTurns::warn(const std::string& id, const char* what)
{
  this->warnings.push_back("node \"" + id.substr(0, 200) + '"' + what);
}

std::string ColladaTurns::idOf(const std::string& id, std::size_t piece) const
{
  return this->Mark + ("t" + std::to_string(piece)) + ':' + id;
}

std::string ColladaTurns::tagOf(const std::string& id, std::size_t piece) const
{
  std::string own = this->idOf(id, piece);
  for (std::size_t at = own.find('"'); at != std::string::npos; at = own.find('"', at))
  {
    own.replace(at, 1, "&quot;"); // it may stand between others
  }
  return "<node id=\"" + own + "\" name=\"" + own + "\">";
}

std::string ColladaTurns::reach(std::size_t piece)
{
  Open& open = this->Stack.back();
  std::string tags;
  while (open.piece < piece)
  {
    ++open.piece;
    tags += open.piece == open.node->last ? open.tag : this->tagOf(open.id, open.piece);
  }
  return tags;
}

std::string ColladaTurns::before(const Markup& markup)
{
  if (this->isAside(markup) || this->Stack.empty())
  {
    return {};
  }
  Open& open = this->Stack.back();
  if (!transformOf(markup).empty() && open.element < open.node->elements.size())
  {
    return this->reach(open.node->last == 0 ? 0 : open.node->elements[open.element++].piece);
  }
  std::string tags = isContent(markup) ? this->reach(open.node->last) : std::string();
  if (markup.isOf("node") && markup.isEnd())
  {
    for (std::size_t i = 0; i < open.node->last; ++i)
    {
      tags += "</node>";
    }
    this->Stack.pop_back();
  }
  return tags;
}

std::string ColladaTurns::tag(const Markup& markup, const std::string& tag)
{
  if (this->Extras > 0 || !(markup.begins("node") || markup.begins("channel")))
  {
    return tag;
  }
  const std::string target = markup.attribute("target");
  const std::string id = markup.begins("node") ? markup.attribute("id") : target.substr(0, slashOf(target));
  const auto found = this->Nodes.find(id);
  if (found == this->Nodes.end() || (markup.begins("node") && markup.isEmpty()))
  {
    return tag;
  }
  Node& node = found->second;
  if (markup.begins("node"))
  {
    this->Stack.push_back({ &node, id, tag });
    return node.last == 0 ? tag : this->tagOf(id, 0);
  }
  const auto piece = node.pieces.find(sidOf(target));
  return node.last == 0 || piece == node.pieces.end() || piece->second == node.last
           ? tag
           : markup.with("channel", "target", this->idOf(id, piece->second) + target.substr(id.size()));
}

} // namespace dgtk::import
