// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColorRows_h
#define dgtkColorRows_h

// Private to Layers.

#include "dgtkLayers.h"
#include "dgtkPictureCurve.h"

namespace dgtk
{

/// Specification of the picture in a format.
LayerSpec colorSpec(const LayerRequest& request, const std::string& format);

/// Colours of rows [y, y + height) of a band as a layer of the type of `spec`: 8 and 16 bits are rounded, float32 is
/// linear light (IEC 61966-2-1). `curve` is applied before.
Rows quantise(const Band& band, const LayerSpec& spec, int y, int height, std::vector<float> Band::*rgb = &Band::rgb,
  const PictureCurve& curve = {});

/// Colours of a band, in the layers' outputs.
std::unique_ptr<LayerPass> makeColorPass(
  const JobContext& context, const std::vector<PassLayer>& layers, std::vector<float> Band::*rgb);

/// An output a format, of a picture of this specification.
std::vector<LayerOutput> colorOutputs(const WorkPlan& plan, const Stage& stage, const Job& job,
  const PlannedLayer& planned, LayerSpec (*specOf)(const LayerRequest& request, const std::string& format));

} // namespace dgtk

#endif
