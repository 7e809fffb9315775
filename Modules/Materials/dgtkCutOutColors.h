// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCutOutColors_h
#define dgtkCutOutColors_h

#include "dgtkMaterialsModule.h"

#include "dgtkModel.h"

#include <cstdint>
#include <vector>

namespace dgtk
{

/// The texels of a picture with holes, RGBA, rows top to bottom: what is cut out has the colour of the nearest texels
/// that are there, so that no fringe appears where texels are averaged. The picture repeats.
DGTKMATERIALS_EXPORT std::vector<std::uint8_t> withoutHoles(const Image& image);

} // namespace dgtk

#endif
