// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRequestOptions_h
#define dgtkRequestOptions_h

#include "dgtkLayersModule.h"

#include "dgtkOption.h"

#include <string>
#include <vector>

namespace dgtk
{

/// Every option that may decide what a picture's layers are: of pictures, of the layers (Layer::options()), of their
/// file formats ("depth_format"), of the engines.
DGTKLAYERS_EXPORT const std::vector<const OptionRow*>& requestOptions();
/// These, and then the options of a run that writes a dataset.
DGTKLAYERS_EXPORT const std::vector<const OptionRow*>& allOptions();
/// One of all, by its name. Throws UsageError when there is none.
DGTKLAYERS_EXPORT const OptionRow& requestOption(const std::string& name);

/// Options that are of no layer.
namespace option
{
DGTKLAYERS_EXPORT const IntegerOption& samples();
DGTKLAYERS_EXPORT const ChoiceOption& filter();
DGTKLAYERS_EXPORT const ChoiceOption& colorBits();
DGTKLAYERS_EXPORT const ChoiceOption& renderer();
DGTKLAYERS_EXPORT const NumbersOption& exposure();
DGTKLAYERS_EXPORT const ChoiceOption& tone();
DGTKLAYERS_EXPORT const ChoiceOption& visibility();
DGTKLAYERS_EXPORT const ChoiceOption& gl();
DGTKLAYERS_EXPORT const IntegerOption& seed();
DGTKLAYERS_EXPORT const IntegerOption& threads();
DGTKLAYERS_EXPORT const SwitchOption& pack();
DGTKLAYERS_EXPORT const SwitchOption& models();
DGTKLAYERS_EXPORT const SwitchOption& contactSheet();
} // namespace option

} // namespace dgtk

#endif
