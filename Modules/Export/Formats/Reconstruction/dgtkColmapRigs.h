// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColmapRigs_h
#define dgtkColmapRigs_h

// Private to Export: cameras that hang together, as COLMAP has them: rigs and frames beside a model (since 3.12), and
// the configuration that rig_bundle_adjuster (until 3.11) and rig_configurator read.

#include "dgtkColmap.h"

namespace dgtk::colmap
{

/// "on" or "off"
const SwitchOption& rigs();

/// Cameras that have the same frames, two at least, one matrix each, and the same places to each other at all of them.
struct Rig
{
  std::vector<std::string> cameras; ///< two or more; the first one is the reference
  std::vector<Rigid3> fromFirst;    ///< a camera's axes from the first one's
};
std::vector<Rig> rigsOf(const DatasetView& dataset);

/// Where rigs are asked for: throws UsageError where there are none, and where the names of pictures do not tell the
/// cameras of a rig apart for COLMAP.
void checkRigs(const DatasetView& dataset, const OptionValues& options, const std::string& format);

/// The files of a model's folder, none where rigs are not asked for.
std::vector<std::string> rigFiles(const std::string& folder, const OptionValues& options);
/// Writes them. `cameraIds`: COLMAP's number of the camera of each of the pictures.
void writeRigs(ExportSink& sink, const DatasetView& dataset, const Views& views,
  const std::vector<std::uint32_t>& cameraIds, const std::vector<std::string>& files);

} // namespace dgtk::colmap

#endif
