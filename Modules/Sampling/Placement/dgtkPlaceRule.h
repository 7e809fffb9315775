// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlaceRule_h
#define dgtkPlaceRule_h

#include "dgtkSampleRule.h"
#include "dgtkSceneDescription.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>

namespace dgtk
{

/// How an object falls.
struct DropRule
{
  double height = 0;        ///< of its lowest point above what it falls on
  double friction = 0.6;    ///< [0, 10]
  double restitution = 0.1; ///< [0, 1]
  double seconds = 10;      ///< in which it must come to rest
  bool keys = false;        ///< the fall becomes key frames
  int from = 0;             ///< frame at which it begins
};

/// A rule `place`, its words known.
struct PlaceRule
{
  std::string path;
  std::size_t object = 0;                    ///< in the description
  std::string lacks;                         ///< see SampleRule
  std::optional<std::size_t> support;        ///< object that it is put on or in; none: `box`
  Eigen::AlignedBox3d box;                   ///< world frame
  bool in = false;                           ///< in the box of the support, or in `box`
  std::optional<Eigen::AlignedBox2d> region; ///< of its middle, along the two axes that are not up
  std::optional<DropRule> drop;
  double clearance = 0;
  std::string proxy; ///< path of a model that stands in for the object's own in the fall; "": none
  int attempts = 100;
  bool refuses = false;            ///< the sample is refused, rather than the object left out
  std::optional<double> tolerance; ///< of penetration and gap
};

/// Throws InputError, naming the place in the file, for what is not a rule.
PlaceRule readPlaceRule(const SampleRule& rule, const SceneDescription& scene);

} // namespace dgtk

#endif
