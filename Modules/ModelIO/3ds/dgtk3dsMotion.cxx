// SPDX-License-Identifier: BSD-3-Clause
#include "dgtk3dsMotion.h"

#include "dgtk3dsChunks.h"

namespace dgtk
{

namespace
{
constexpr std::size_t motionHeader = 6;

/// Calls visit(id, begin and end of the contents) for each chunk.
template <class Visit>
void forEachChunk(const ByteReader& in, std::size_t begin, std::size_t end, Visit visit)
{
  for (std::size_t at = begin; at + motionHeader <= end;)
  {
    const std::size_t length = in.u32(at + 2);
    if (length < motionHeader || length > end - at)
    {
      return;
    }
    visit(in.u16(at), at + motionHeader, at + length);
    at += length;
  }
}

bool moves(const ByteReader& in, std::size_t begin, std::size_t end)
{
  constexpr std::size_t countAt = 10; // behind flags and eight bytes of no use
  bool found = false;
  forEachChunk(in, begin, end,
    [&](std::uint16_t id, std::size_t track, std::size_t trackEnd)
    {
      const bool isTrack = id == PositionTrack || id == RotationTrack || id == ScaleTrack || id == MorphTrack;
      found = found || (isTrack && trackEnd - track >= countAt + 4 && in.u32(track + countAt) > 1);
    });
  return found;
}
} // namespace

std::size_t countMoving3ds(const ByteReader& in)
{
  std::size_t count = 0;
  forEachChunk(in, motionHeader, in.size(),
    [&](std::uint16_t id, std::size_t begin, std::size_t end)
    {
      forEachChunk(in, begin, id == KeyFramer ? end : begin,
        [&](std::uint16_t node, std::size_t nodeBegin, std::size_t nodeEnd)
        { count += node == ObjectNode && moves(in, nodeBegin, nodeEnd) ? 1 : 0; });
    });
  return count;
}

} // namespace dgtk
