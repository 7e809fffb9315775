// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureEnd_h
#define dgtkPictureEnd_h

#include <cstddef>
#include <cstdint>

namespace dgtk::picture
{

/// Whether a file in memory is an SGI or TIFF picture whose own tables place rows beyond its end, which their decoders
/// fill or take from elsewhere. False for all other files, however damaged.
bool lacksItsEnd(const std::uint8_t* data, std::size_t bytes);

} // namespace dgtk::picture

#endif
