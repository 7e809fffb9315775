// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraRequirement_h
#define dgtkCameraRequirement_h

#include "dgtkSampleRule.h"
#include "dgtkSampleWorld.h"
#include "dgtkSceneDescription.h"

#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// What a rule `require` asks of a camera. Throws InputError for what it cannot mean.
struct CameraRequirement
{
  struct Visible
  {
    std::string pattern;
    double share = 0; ///< of each object like it: pixels that are seen / pixels of it alone, in the image
  };
  std::vector<Visible> visible;
  double clearance = 0; ///< scene units from the camera to the nearest surface
  bool clear = false;   ///< it is asked for
  int attempts = 100;
  bool omit = false;
  int pixels = 160; ///< larger side of the image that shares are counted in

  static CameraRequirement read(const JsonDocument& rule);
};

/// How a camera fulfils it, at the scene's key frames (32 of them at most, spread evenly): the worst of each.
struct CameraFit
{
  bool fits = true;
  std::string why;                                      ///< it does not
  std::vector<std::pair<std::string, double>> measured; ///< "visible cup*", "clearance"; as far as it was looked
};
CameraFit fitOf(const CameraRequirement& wanted, const CameraDescription& camera, const std::vector<int>& keyFrames,
  SampleWorld& world);

} // namespace dgtk

#endif
