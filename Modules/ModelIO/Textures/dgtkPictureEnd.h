// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureEnd_h
#define dgtkPictureEnd_h

#include <cstddef>
#include <cstdint>

namespace dgtk::picture
{

/// Whether a file in memory is an SGI, TIFF or WebP picture that places rows beyond its end, which decoders fill, take
/// from elsewhere or have no word for. False for all other files, however damaged.
bool lacksItsEnd(const std::uint8_t* data, std::size_t bytes);

} // namespace dgtk::picture

#endif
