// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSparseText_h
#define dgtkSparseText_h

#include "dgtkSparseCorrespondence.h"

#include <string>
#include <vector>

namespace dgtk
{

/// A view by its name, as files of matches have it.
struct SparseView
{
  std::string camera; ///< empty: the file does not say
  int frame = 0;
  int width = 0; ///< pixels
  int height = 0;
  bool operator==(const SparseView& o) const
  {
    return this->camera == o.camera && this->frame == o.frame && this->width == o.width && this->height == o.height;
  }
};

/// Matches of one ordered pair of views.
struct SparseSet
{
  SparseView from;
  SparseView to;
  std::vector<SparseMatch> matches; ///< hit.triangle is not kept in files
};

/// Lines "x y x' y' class object" below three comments: the two views and the names of the columns. Numbers are the
/// shortest that are read back as the same.
DGTKPIPELINE_EXPORT std::string sparseText(const SparseSet& set);

/// Reads what sparseText() wrote, also several one after the other. Lines before the first named views have views
/// without a name. Throws InputError with `name` and the line.
DGTKPIPELINE_EXPORT std::vector<SparseSet> parseSparseText(const std::string& text, const std::string& name);

/// Points of the image of a view, pixels: the first two numbers of lines with two numbers, or with the six of
/// sparseText(), separated by blanks or commas; empty lines and what follows a # do not count. Throws InputError with
/// `name` and the line, also for a point outside.
DGTKPIPELINE_EXPORT std::vector<Eigen::Vector2d> parsePoints(
  const std::string& text, const std::string& name, const SparseView& view);

} // namespace dgtk

#endif
