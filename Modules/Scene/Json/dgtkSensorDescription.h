// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSensorDescription_h
#define dgtkSensorDescription_h

// Private to Scene: how a camera's `sensor` is read, checked and written. The values are dgtkSensorParameters.h.

#include "dgtkSceneJson.h"

namespace dgtk::scenefile
{

/// The row `sensor` of a camera.
JsonField<CameraDescription> sensorRow();

/// The keys of the sensor's tables, by the name of their definition in the published schema.
std::map<std::string, std::vector<std::string>> sensorKeys();

/// What is wrong between values ("" when nothing is), for errors behind the key path: "psf has ...".
std::string faultOf(const ColorSensorParameters& sensor);
std::string faultOf(const DepthSensorParameters& sensor);

} // namespace dgtk::scenefile

#endif
