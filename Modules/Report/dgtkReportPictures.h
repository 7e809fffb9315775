// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportPictures_h
#define dgtkReportPictures_h

// Private to Report: reading a layer's pictures once, for what is shown and what is counted.

#include "dgtkReportLayers.h"
#include "dgtkReportTally.h"
#include "dgtkThreadPool.h"

#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

/// Samples of a picture at fewer pixels.
struct ReportSamples
{
  ImageInfo info; ///< of the file
  int width = 0;  ///< of the samples
  int height = 0;
  std::vector<double> drawn; ///< pictures averaged, all else the pixels in the middle
  std::vector<double>
    exact; ///< of the pixel whose column is the middle of those that a sample stands for, rows likewise
};

/// What is counted in one picture.
struct PictureCounts
{
  NumberTally numbers;
  ShareTally brightness{ 64 };
  IdTally ids;
};

/// Middle of the source pixels that sample i of `samples` stands for. The page computes the same.
int middleOf(int i, int samples, int pixels);

/// One layer: everything that is counted, and what its shown pictures become.
struct LayerResult
{
  NumberTally numbers;
  ShareTally brightness{ 64 };
  std::map<std::size_t, IdTally> ids;    ///< by picture
  std::map<std::size_t, double> means;   ///< brightness by picture
  std::map<std::size_t, double> covered; ///< share of pixels that have a value or an id, by picture
  std::size_t counted = 0;               ///< pictures
  ReportJson legend;
  std::vector<std::string> notes;
};

/// Reads a layer's pictures that are shown or counted, and gives each shown one to `write`: its number among the
/// shown, and the text of its block: a PNG in base64, '|', the values. `side`: longest side of what is shown, pixels.
LayerResult readLayer(const ReportSource& source, const ReportLayer& layer, int side, ThreadPool& pool,
  const std::function<void(std::size_t shown, const std::string& text)>& write);

} // namespace dgtk

#endif
