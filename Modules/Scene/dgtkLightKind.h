// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLightKind_h
#define dgtkLightKind_h

#include <algorithm>
#include <vector>

namespace dgtk
{

enum class LightKind
{
  Point,
  Head,
  Directional,
  Spot
};

/// What a kind of light has. How it shines, is read, written, shown and moved follows from it.
struct LightTraits
{
  LightKind kind;
  const char* word; ///< as in scene files
  bool placed;      ///< it has a position in the world; otherwise it is at the camera, along its view
  bool aimed;       ///< it shines from its position towards a target
  bool near;        ///< it is at its place and fades with the distance; otherwise it is infinitely far
  bool cone;        ///< it has an angle and an exponent
  bool shadows;     ///< objects can cast shadows in it
};

/// One row a kind, in the order in which they are offered.
inline const std::vector<LightTraits>& lightKinds()
{
  static const std::vector<LightTraits> kinds{
    // kind, word, placed, aimed, near, cone, shadows
    { LightKind::Point, "point", true, false, true, false, true },
    { LightKind::Head, "head", false, false, false, false, false },
    { LightKind::Directional, "directional", true, true, false, false, true },
    { LightKind::Spot, "spot", true, true, true, true, true },
  };
  return kinds;
}

inline const LightTraits& traitsOf(LightKind kind)
{
  const std::vector<LightTraits>& all = lightKinds();
  return *std::find_if(all.begin(), all.end(), [kind](const LightTraits& one) { return one.kind == kind; });
}

} // namespace dgtk

#endif
