// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportPainting_h
#define dgtkReportPainting_h

#include "dgtkLayerColors.h"
#include "dgtkReportPictures.h"

namespace dgtk
{

/// Colours of a layer, with one range for all pictures, and what the page says of them.
struct Painting
{
  LayerColors colors;
  ReportJson legend;
};

/// What colours a layer: its first picture of values, else its first one.
const ReportSamples& exampleOf(const std::vector<ReportSamples>& all);

Painting paintingOf(const ReportLayer& layer, const std::vector<ReportSamples>& all);

/// "width height pixel-width pixel-height channels type|png|values": a PNG in these colours, and the exact values
/// packed, both in base64 (RFC 4648).
std::string blockOf(const ReportSamples& samples, const LayerColors& colors);

} // namespace dgtk

#endif
