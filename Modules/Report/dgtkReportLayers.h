// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportLayers_h
#define dgtkReportLayers_h

#include "dgtkReportSource.h"

#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// What is counted of a layer's pixels.
enum class Counted
{
  Nothing,
  Numbers,    ///< depths, distances, lengths of displacements
  Brightness, ///< of pictures of 8 and 16 bits
  Objects,    ///< ids
  Classes
};

/// A kind of picture: a layer, told apart by its folder where it has several ("correspondence_right").
struct ReportLayer
{
  std::string label;
  LayerSpec spec;
  std::map<std::size_t, std::string> files; ///< by picture, of those that are read; relative to the scene's folder
};

/// By meaning and format: a picture of depths has no values.
Counted countedOf(const LayerSpec& spec, const std::string& path);

/// In the order of the manifests. Of a layer with several formats the one with its values, of pictures PNG.
std::vector<ReportLayer> reportLayers(const ReportSource& source);

} // namespace dgtk

#endif
