// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTexturePixels_h
#define dgtkTexturePixels_h

#include "dgtkModel.h"
#include "dgtkPictureProcess.h"
#include "dgtkTextureFile.h"

#include <memory>
#include <string>

namespace dgtk
{

/// What is known of an alpha channel.
enum class AlphaRule
{
  Painted, ///< one that is 0 everywhere was never painted, and is taken as absent
  Meant    ///< it is as the file has it
};

/// Takes what the picture's pixels will need; `size`: what its header says. False, and `problem` set, when it is no
/// picture.
bool takeTexels(const picture::Source& source, TextureStore& store, picture::Answer& size, std::string& problem);

/// Decodes, whatever the memory. Null, and `problem` set, when it cannot be decoded.
std::shared_ptr<const Image> decodeTexels(
  const picture::Source& source, TextureUse use, AlphaRule rule, std::string& problem);

/// Settles Image::hasAlpha.
void settleAlpha(Image& image, AlphaRule rule);

} // namespace dgtk

#endif
