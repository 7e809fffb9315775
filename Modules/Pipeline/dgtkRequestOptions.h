// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRequestOptions_h
#define dgtkRequestOptions_h

#include "dgtkPipelineModule.h"

#include "dgtkOption.h"

#include <string>
#include <vector>

namespace dgtk
{

/// Every option that may decide what a picture's layers are: of pictures, of the layers (Layer::options()), of their
/// file formats ("depth_format"), of the engines.
DGTKPIPELINE_EXPORT const std::vector<const OptionRow*>& requestOptions();
/// Options of a run that writes a dataset, besides.
DGTKPIPELINE_EXPORT const std::vector<const OptionRow*>& runOptions();
/// One of either, by its name. Throws UsageError when there is none.
DGTKPIPELINE_EXPORT const OptionRow& requestOption(const std::string& name);

/// Options that are of no layer.
namespace option
{
DGTKPIPELINE_EXPORT const IntegerOption& samples();
DGTKPIPELINE_EXPORT const ChoiceOption& filter();
DGTKPIPELINE_EXPORT const ChoiceOption& colorBits();
DGTKPIPELINE_EXPORT const ChoiceOption& renderer();
DGTKPIPELINE_EXPORT const ChoiceOption& visibility();
DGTKPIPELINE_EXPORT const ChoiceOption& gl();
DGTKPIPELINE_EXPORT const IntegerOption& seed();
DGTKPIPELINE_EXPORT const IntegerOption& threads();
DGTKPIPELINE_EXPORT const SwitchOption& pack();
DGTKPIPELINE_EXPORT const SwitchOption& contactSheet();
} // namespace option

} // namespace dgtk

#endif
