// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadColmapRigs_h
#define dgtkReadColmapRigs_h

#include "dgtkExportJudge.h"

#include <cstdint>
#include <map>
#include <string>

namespace dgtk
{

/// A picture of a model of COLMAP's.
struct RiggedImage
{
  std::uint32_t camera = 0;
  const ExportedName* picture = nullptr;
};

/// The rigs and frames beside a model, where there are: what they say of a picture's pose, and that every picture is in
/// one frame. `images` by number, `extension` ".bin" or ".txt".
void judgeColmapRigs(ExportJudge& judge, const std::string& folder, const std::string& extension,
  const std::map<std::uint32_t, RiggedImage>& images);

} // namespace dgtk

#endif
