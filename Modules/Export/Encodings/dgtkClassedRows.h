// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkClassedRows_h
#define dgtkClassedRows_h

// Private to Export.

#include "dgtkDatasetView.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Rows of a layer from top to bottom. Values that are not finite are NaN, and so are those whose visibility class, in
/// the class image of the layer, is not among `classes` (none: all count).
class ClassedRows
{
public:
  ClassedRows(const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
    const std::vector<double>& classes = {});
  const ImageInfo& info() const { return this->Values->info(); }
  void next();
  double at(int x, int channel = 0) const;

private:
  std::unique_ptr<RowReader> Values;
  std::unique_ptr<RowReader> Classes; ///< null: all count
  std::vector<double> Wanted;
  Rows Row;
  Rows ClassRow;
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
