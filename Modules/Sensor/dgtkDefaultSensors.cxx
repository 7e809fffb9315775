// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkImageSensor.h"

namespace dgtk
{

ColorSensorParameters defaultColorSensor()
{
  ColorSensorParameters p;
  p.psf.gaussian = 0.6;
  p.vignetting.cos4 = 1;
  p.fullWell = 10000;
  p.shotNoise = true;
  p.prnu = 0.005;
  p.dsnu = 1;
  p.readNoise = 2.5;
  p.bits = 12;
  p.bayer = BayerPattern::RGGB;
  return p;
}

DepthSensorParameters defaultDepthSensor()
{
  DepthSensorParameters p;
  p.kinect.axial = 1;
  p.kinect.lateral = 1;
  p.least = 0.4;
  p.most = 8;
  p.dropout.edge = 0.5;
  p.dropout.grazing = 0.5;
  return p;
}

} // namespace dgtk
