// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColladaSurvey_h
#define dgtkColladaSurvey_h

#include "dgtkColladaMarkup.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dgtk::import
{

/// What stands in several places of a Collada file, or far from where it counts.
class ColladaSurvey
{
public:
  explicit ColladaSurvey(const std::string& xml);

  std::string problem; ///< why the file is refused, or ""
  std::vector<std::string> warnings;
  std::set<std::string> nodes;  ///< ids
  std::set<std::string> joints; ///< sids
  /// Sets of texture coordinates that the picture of a geometry's material (its symbol) is bound to.
  std::map<std::pair<std::string, std::string>, std::set<int>> bound;
  std::map<std::string, std::set<int>> sets; ///< of texture coordinates, by geometry
  std::set<std::string> channels;            ///< names that effects give such sets and that are bound
  bool hasClips = false;                     ///< of animations

private:
  struct Binding
  {
    std::string instance;
    std::string symbol;
    std::string channel;
    int set = 0;
  };

  void lookAt(const Markup& markup);
  void lookAtNode(const Markup& node);
  void lookAtCoordinates(const Markup& markup);
  void bind();
  void warnOf();

  std::map<std::string, std::string> Skinned; ///< geometries by controller
  std::vector<Binding> Bindings;
  std::map<int, std::string> Pictures; ///< of an effect: the channels of those that are drawn, the first one's first
  std::set<std::string> Drawn;         ///< channels of the first ones
  std::set<std::string> Beside;        ///< of the others
  std::string Geometry;                ///< where the walk is, as all of the following
  std::string Controller;
  std::string Instance;
  std::string Symbol;
  int Extras = 0;   ///< open ones
  int Element = -1; ///< whose picture may stand here, of those that are drawn
  bool IsAnimation = false;
  bool HasSeveral = false; ///< sets of texture coordinates that one material is bound to
  bool HasTwins = false;   ///< joints of one sid
  bool HasSkins = false;   ///< which are drawn
  bool HasCurves = false;  ///< keys with something else than a line between them
};

/// A set's number as it is written; -1 when it is none.
int setOf(const std::string& written);

/// Without the `#` of a reference.
std::string idOf(const std::string& reference);

} // namespace dgtk::import

#endif
