// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColladaTurns_h
#define dgtkColladaTurns_h

#include "dgtkColladaMarkup.h"

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dgtk::import
{

/// Assimp 5.2 has a place and a turn of each node at its keys, and lines between the places: what turns about a pivot
/// would be on the chord, and what turns about several axes would take another way. Each such turn becomes a node of
/// its own, in which it is all there is.
class ColladaTurns
{
public:
  /// `mark` begins ids and names of the nodes that are made.
  ColladaTurns(const std::string& xml, char mark);

  std::vector<std::string> warnings;

  /// What to write before a markup. Of all markups of the file, in their order.
  std::string before(const Markup& markup);
  /// What to write instead of the tag of a node that begins, or of another one.
  std::string tag(const Markup& markup, const std::string& tag);

private:
  struct Element
  {
    std::string kind;
    std::string sid;
    std::size_t piece = 0; ///< which of the nodes that its own becomes
  };
  struct Node
  {
    std::vector<Element> elements;
    std::size_t last = 0;                      ///< piece; this one has the node's own tag
    std::size_t tags = 0;                      ///< of that id
    std::map<std::string, std::size_t> pieces; ///< of transforms that move, by sid
    bool isOfLibrary = false;
    bool isMixed = false; ///< a transform stands behind what it moves
  };
  struct Open
  {
    Node* node = nullptr;
    std::string id;
    std::string tag;
    std::size_t element = 0; ///< the next one
    std::size_t piece = 0;
    bool hasContent = false;
  };

  void lookAt(const Markup& markup);
  void divide(const std::string& id, Node& node);
  void warn(const std::string& id, const char* what);
  /// Opens the pieces of the innermost node up to one.
  std::string reach(std::size_t piece);
  std::string idOf(const std::string& id, std::size_t piece) const;
  std::string tagOf(const std::string& id, std::size_t piece) const;
  bool isAside(const Markup& markup);

  char Mark;
  std::map<std::string, Node> Nodes;                   ///< by id
  std::map<std::string, std::set<std::string>> Moving; ///< sids by id of their node
  std::set<std::string> Instanced;
  std::vector<Open> Stack;
  int Extras = 0; ///< open ones
  bool IsLibrary = false;
};

} // namespace dgtk::import

#endif
