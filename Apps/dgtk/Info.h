// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAppInfo_h
#define dgtkAppInfo_h

#include "Options.h"

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <string>

namespace dgtk::app
{

using Json = nlohmann::ordered_json;

/// [x, y, z].
Json vector(const Eigen::Vector3d& v);

/// What `dgtk info` prints of a scene (options --size and --surfaces) and of a dataset's folder.
Json infoOfScene(const std::string& path, const Arguments& arguments);
/// Of a .json scene with random values: where they stand.
bool isRandomScene(const std::string& path);
Json infoOfRandomScene(const std::string& path);
Json infoOfDataset(const std::string& folder);

} // namespace dgtk::app

#endif
