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
  std::set<std::string> Drawn; ///< channels of pictures of colour
  std::string Geometry;        ///< where the walk is, as all of the following
  std::string Controller;
  std::string Instance;
  std::string Symbol;
  int Extras = 0; ///< open ones
  bool IsDiffuse = false;
  bool IsAnimation = false;
  bool HasTwins = false;  ///< joints of one sid
  bool HasSkins = false;  ///< which are drawn
  bool HasCurves = false; ///< keys with something else than a line between them
};

/// A set's number as it is written; -1 when it is none.
int setOf(const std::string& written);

/// Without the `#` of a reference.
std::string idOf(const std::string& reference);

} // namespace dgtk::import

#endif
