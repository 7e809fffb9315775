// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureProtocol_h
#define dgtkPictureProtocol_h

#include <cstddef>
#include <cstdint>

/// What the library asks dgtk-picture and dgtk-picture-any, and what they answer (dgtkHelperChannel.h). The encoded
/// picture comes in shared memory; the pixels go back in shared memory that the library has made, of a size that nobody
/// can change.
namespace dgtk::picture
{

constexpr int largestSide = 16384;

enum class Step : std::uint32_t
{
  Measure, ///< with the encoded picture: what its header says
  Decode   ///< with the encoded picture and the memory for its pixels
};

enum class Values : std::uint32_t
{
  Bytes,  ///< 8 bits a channel, at most 4 channels, values as in the file
  Codes,  ///< the same, but light becomes its sRGB codes; what is brighter than white is white
  Floats, ///< 32-bit floats, at most 3 channels
};

struct Request
{
  Step step = Step::Measure;
  Values values = Values::Bytes;
  std::uint64_t fileBytes = 0;
  char extension[16] = {}; ///< lower case, no dot: which decoder is tried first
};

enum class Status : std::uint32_t
{
  Done,
  Refused,   ///< `problem` says why
  Elsewhere, ///< not of the kinds that dgtk-picture decodes, or not surely sound: dgtk-picture-any is to judge
  NoRoom,    ///< the machine's limit of memory is in the way, not the picture
  Bye        ///< nothing was asked for a while: the helper ends; ask another
};

struct Answer
{
  Status status = Status::Refused;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t channels = 0;
  std::int32_t linear = 0;  ///< its values are light as they are, not sRGB
  std::int32_t cramped = 0; ///< decoding may want more memory than the machine's limit leaves
  char problem[400] = {};
};

/// Rows top to bottom, pixels left to right, channels of a pixel together.
inline std::uint64_t pixelBytes(const Answer& size, Values values)
{
  return std::uint64_t(size.width) * std::uint64_t(size.height) * std::uint64_t(size.channels) *
         (values == Values::Floats ? sizeof(float) : 1);
}

} // namespace dgtk::picture

#endif
