// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStereoScenes_h
#define dgtkStereoScenes_h

// Private to Export: the stereo sets of Middlebury and ETH3D, a folder a pair and frame.

#include "dgtkExporter.h"

#include <memory>
#include <string>

namespace dgtk
{

/// Where a set has its files. "%" stands for the scene.
struct StereoLayout
{
  std::string format;
  std::string pictures;              ///< folder of im0.png, im1.png and calib.txt
  std::string truth;                 ///< folder of disparities and mask0nocc.png
  std::vector<std::string> leftMaps; ///< file names of the left image's disparity
  std::string rightMap;              ///< of the right one's; "" for none
};

std::unique_ptr<Exporter> makeStereoExporter(const StereoLayout& layout);

} // namespace dgtk

#endif
