// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportSource_h
#define dgtkReportSource_h

#include "dgtkDatasetView.h"
#include "dgtkReport.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// One dataset of the folder.
struct ReportScene
{
  std::string name; ///< of its folder; "" where the folder is the dataset
  std::unique_ptr<DatasetView> view;
};

/// A camera of a scene at a frame.
struct ReportPicture
{
  std::size_t scene = 0; ///< in ReportSource::scenes
  const DatasetShot* shot = nullptr;
};

/// The datasets of a folder, and which of their pictures are looked at.
struct ReportSource
{
  ReportSource(const ReportRequest& request);

  const DatasetView& viewOf(const ReportPicture& picture) const { return *this->scenes[picture.scene].view; }

  bool many = false; ///< scenes in folders of their own
  std::size_t scenesFound = 0;
  std::vector<ReportScene> scenes;     ///< whose documents were read, by name
  std::vector<ReportPicture> pictures; ///< all of these
  std::vector<std::size_t> read;       ///< of `pictures`, ascending
  std::vector<std::size_t> shown;      ///< of `pictures`, ascending; all of them are among `read`
  std::vector<std::string> notes;
};

/// `count` (0: all) of the numbers from 0 to total - 1, ascending: those whose random numbers of this seed are least. A
/// smaller count gives some of those that a larger one gives.
std::vector<std::size_t> drawnOf(std::size_t total, std::size_t count, std::uint64_t seed, std::uint32_t stream);

} // namespace dgtk

#endif
