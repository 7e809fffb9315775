// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkClassedRows_h
#define dgtkClassedRows_h

#include "dgtkDatasetView.h"

#include "dgtkExportDocument.h"

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
/// is not wanted.
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

private:
  struct Filter
  {
    std::unique_ptr<RowReader> reader;
    std::vector<double> wanted;
    Rows rows;
  };
  std::unique_ptr<RowReader> Values;
  std::vector<Filter> Filters;
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
