// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneRules_h
#define dgtkSceneRules_h

// Private to Scene: what values may be, said once for the readers and for scenes made by program.

#include "dgtkJson.h"
#include "dgtkSceneDescription.h"

#include <functional>
#include <string>

namespace dgtk::scenefile
{

namespace rules
{
inline constexpr Range none{ 0, 0, false, false, "" }; ///< for values without a range
inline constexpr Range coordinate{ -1e15, 1e15, false, false, "a number from -1e15 to 1e15" };
inline constexpr Range scale{ -1e12, 1e12, false, false, "a number other than 0, from -1e12 to 1e12" };
inline constexpr Range unit{ 0, 1, false, false, "a number from 0 to 1" };
inline constexpr Range exponent{ 0, 128, false, false, "a number from 0 to 128" };
inline constexpr Range light{ 0, 1e6, false, false, "a number from 0 to 1e6" };
inline constexpr Range coneAngle{ 0, 90, true, false, "degrees above 0, up to 90" };
inline constexpr Range fovY{ 0, 180, true, true, "degrees above 0 and below 180" };
inline constexpr Range length{ 0, 1e15, true, false, "a number above 0, up to 1e15" };
inline constexpr Range aspect{ 0, 1e6, false, false, "a number from 0 to 1e6" };
inline constexpr Range fps{ 0, 1e6, true, false, "a number above 0, up to 1e6" };
inline constexpr Range rate{ 0, 1e6, false, false, "a number from 0 to 1e6" };
inline constexpr Range modelFrame{ 0, 1e9, false, false, "a number from 0 to 1e9" };
inline constexpr Range startFrame{ -1e9, 1e9, false, false, "a number from -1e9 to 1e9" };
inline constexpr Range frame{ 0, largestFrame, false, false, "a whole number from 0 to 999999" };
inline constexpr Range size{ 0, 1 << 20, false, false, "a whole number from 0 to 1048576" };
inline constexpr Range degrees{ -36000, 36000, false, false, "degrees from -36000 to 36000" };
inline constexpr Range shadowSize{ 16, 16384, false, false, "a whole number from 16 to 16384" };
inline constexpr Range exposures{ 1, 65536, false, false, "a whole number from 1 to 65536" };
inline constexpr Range shutter{ -1000, 1000, false, false, "frames from -1000 to 1000" };
inline constexpr Range rollingShutter{ 0, 1000, false, false, "frames from 0 to 1000" };
inline constexpr Range notNegative{ 0, 1e15, false, false, "a number from 0 to 1e15" };
inline constexpr Range classId{ 1, largestClassId, false, false, "a whole number from 1 to 65535" };
inline constexpr Range colorByte{ 0, 255, false, false, "a whole number from 0 to 255" };
inline constexpr Range keypoint{ 1, 65535, false, false, "a whole number from 1 to 65535" };
inline constexpr Range vertex{ 0, 4294967295.0, false, false, "a whole number from 0 to 4294967295" };
inline constexpr Range metres{ 0, 1e15, true, false, "metres above 0, up to 1e15" };
inline constexpr Range seed{ 0, 9007199254740991.0, false, false, "a whole number from 0 to 2^53 - 1" };
inline constexpr double quaternionTolerance =
  0.01; ///< of the norm: numbers with two decimals, as the thesis prints them
} // namespace rules

/// What is wrong with a value ("" when nothing is): the text says what is expected.
std::string faultOf(const Quaternion& q);
std::string faultOf(const Eigen::Matrix3d& K);
std::string faultOfCameraName(const std::string& name);

/// Where a property of an item stands, and how an error names it: "cameras[0].near" or "camera 'Camera0': near".
struct Place
{
  long line = 0;
  std::string what;
};
using Locator = std::function<Place(SceneItem::Kind kind, std::size_t index, const std::string& property)>;
/// By the items' names and lines.
Locator locateByName(const SceneDescription& scene);

/// Rules between values: unique names, parents, near < far, poses, sizes, order.
void validateRelations(const SceneDescription& scene, const Locator& locate);

} // namespace dgtk::scenefile

#endif
