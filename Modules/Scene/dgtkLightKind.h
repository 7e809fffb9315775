// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLightKind_h
#define dgtkLightKind_h

#include <algorithm>
#include <cstddef>
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

/// How light comes to a point; `dgtkLightLaw.h` computes it.
enum class LightLaw
{
  Parallel, ///< from far away, everywhere alike
  Point,    ///< from a place, fading with the distance
  Cone      ///< the same within an angle about an axis only
};
constexpr std::size_t lightLawCount = 3;

/// A word of scene files for which the translators have one of the editor's languages.
constexpr const char* translated(const char* /*context*/, const char* word) { return word; }

/// What a kind of light has. How it shines, is read, written, shown and moved follows from it.
struct LightTraits
{
  LightKind kind;
  const char* word; ///< as in scene files
  LightLaw law;
  bool placed;  ///< it has a position in the world; otherwise it is at the camera, along its view
  bool aimed;   ///< it shines from its position towards a target
  bool near;    ///< it is at its place and fades with the distance; otherwise it is infinitely far
  bool cone;    ///< it has an angle and an exponent
  bool shadows; ///< objects can cast shadows in it
};

/// One row a kind, in the order in which they are offered.
inline const std::vector<LightTraits>& lightKinds()
{
  static const std::vector<LightTraits> kinds{
    // kind, word, law, placed, aimed, near, cone, shadows
    { LightKind::Point, translated("dgtk::LightKind", "point"), LightLaw::Point, true, false, true, false, true },
    { LightKind::Head, translated("dgtk::LightKind", "head"), LightLaw::Parallel, false, false, false, false, false },
    { LightKind::Directional, translated("dgtk::LightKind", "directional"), LightLaw::Parallel, true, true, false,
      false, true },
    { LightKind::Spot, translated("dgtk::LightKind", "spot"), LightLaw::Cone, true, true, true, true, true },
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
