// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMosaic_h
#define dgtkMosaic_h

#include "dgtkRowWindow.h"
#include "dgtkSensorParameters.h"

namespace dgtk::sensor
{

/// Channel (0 red, 1 green, 2 blue) of the photosite of a pixel.
int bayerChannel(BayerPattern pattern, int x, int y);

/// Row y of 3 channels from rows of one value a pixel: the missing colours are the mean of the nearest photosites of
/// that colour in the 3 x 3 neighbourhood (bilinear); the image is mirrored about the centres of its outermost pixels.
std::vector<float> demosaicRow(const RowWindow<float>& rows, int height, BayerPattern pattern, int y);

} // namespace dgtk::sensor

#endif
