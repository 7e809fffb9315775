// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkClassedRows_h
#define dgtkClassedRows_h

#include "dgtkDatasetView.h"
#include "dgtkExporter.h"

#include "dgtkExportDocument.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Visibility classes that are wanted, by the layer whose class image says them.
using WantedClasses = std::map<std::string, std::vector<double>>;
/// Says them in the encoding of a file of pixels of a layer.
void addClasses(PixelEncoding& encoding, const std::string& layer, const WantedClasses& classes);

/// Rows of a layer from top to bottom. Values that are not finite are NaN, and so are those of pixels with a class that
/// is not wanted. Where no class is said to be wanted, all are that have a place in the other image: what is no longer
/// there (class 0) has a value in the dataset, which formats without classes could not tell from others.
class ClassedRows
{
public:
  ClassedRows(
    const DatasetView& dataset, const DatasetShot& shot, const std::string& layer, const WantedClasses& classes = {});
  const ImageInfo& info() const { return this->Values->info(); }
  void next();
  double at(int x, int channel = 0) const;
  /// The values of a row's first channel.
  void row(std::vector<double>& values) const;
  /// Of the rows so far: counts the values of what is no longer there as without code, in pixels; `channels` of them
  /// are counted one by one.
  void reportGone(ExportSink& sink, int channels) const;

private:
  struct Filter
  {
    std::unique_ptr<RowReader> reader;
    std::vector<double> wanted;
    Rows rows;
  };
  void countGone();
  std::string Layer;
  std::unique_ptr<RowReader> Values;
  std::vector<Filter> Filters;
  std::uint64_t Gone = 0;
  Rows Block; ///< several rows at a time
  int Y = -1;
};

/// Visibility classes of surface points that are seen in the other image, and of all that have a place there.
inline const std::vector<double>& seenClasses()
{
  static const std::vector<double> classes{ 1 };
  return classes;
}
inline const std::vector<double>& placedClasses()
{
  static const std::vector<double> classes{ 1, 2, 3, 4 };
  return classes;
}

} // namespace dgtk

#endif
