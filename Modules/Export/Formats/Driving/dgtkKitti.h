// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkKitti_h
#define dgtkKitti_h

// Private to Export: what the sets of KITTI share.

#include "dgtkExportPng.h"
#include "dgtkExporter.h"

#include <string>

namespace dgtk::kitti
{

/// Metres or pixels as 16-bit codes, 256 a unit, 0 for nothing.
LinearCode code256(double factor, const std::string& unit);
/// Flow as 16-bit R, G (64 a pixel, 32768 is 0) and B, 1 where there is one; of these visibility classes.
void writeFlow(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const WantedClasses& classes, const OptionValues& options);

/// K [I | offset] of a camera, 12 numbers, in KITTI's pixels; offset in metres along x.
std::string projectionLine(const CameraRecord& camera, double offset);
/// calib_cam_to_cam.txt: cameras 00 and 02 are the left one, 01 and 03 the right one. Without a right one it is the
/// left one again.
std::string camToCam(const CameraRecord& left, const CameraRecord* right, double baseline);
/// Camera axes from those of a laser scanner, x forward, y left, z up, at the same place: 12 numbers.
std::string scannerLine();

/// What all say of themselves.
TextPairs conventions(const DatasetView& dataset);

} // namespace dgtk::kitti

#endif
