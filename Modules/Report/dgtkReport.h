// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReport_h
#define dgtkReport_h

#include "dgtkReportModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// What a report shows, and from how much it is made. Time and memory grow with `shown` and `read`, not with the
/// dataset.
struct ReportRequest
{
  std::string dataset;    ///< a dataset, or a folder whose folders are datasets: one of many scenes
  std::string file;       ///< the page
  std::size_t shown = 48; ///< pictures on the sheet, in all layers; 0: all of those that are read
  std::size_t read = 240; ///< pictures that distributions are made from; 0: all
  std::uint64_t seed = 0; ///< of which pictures these are
  int threads = 1;
  std::string verification;         ///< a file of verificationText(); "": verification.json of the dataset, if there
  std::vector<std::string> exports; ///< folders with export.json
  std::string samples;              ///< what sampling wrote of the scenes; "": samples.json of the dataset, if there
};

struct ReportResult
{
  std::size_t pictures = 0; ///< of the dataset, as far as its scenes were looked at
  std::size_t read = 0;
  std::size_t shown = 0;
  std::size_t layers = 0;
  std::uint64_t bytes = 0;        ///< of the page
  std::vector<std::string> notes; ///< what could not be read, a line each; they stand in the page, too
};

/// Called with layers done and all layers.
using ReportProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Writes one HTML file that needs nothing beside it: no request leaves it. The same bytes for the same dataset and
/// request, whatever the threads. Files of pictures that cannot be read are notes of the page. Throws InputError for
/// what is no dataset and for documents that cannot be read, UsageError for a page in a dataset's folder,
/// MachineError where it cannot be written.
DGTKREPORT_EXPORT ReportResult writeReport(const ReportRequest& request, const ReportProgress& progress = {});

} // namespace dgtk

#endif
