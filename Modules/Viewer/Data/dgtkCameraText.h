// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraText_h
#define dgtkCameraText_h

#include "dgtkDatasetPictures.h"

#include <QString>

namespace dgtk
{

/// The calibration of a camera at a frame as lines: size, lens, K, R and t of cameras.json with all digits, and the
/// file of the layer `calibration` where there is one.
QString cameraText(const DatasetPictures& dataset, const std::string& camera, int frame);

} // namespace dgtk

#endif
