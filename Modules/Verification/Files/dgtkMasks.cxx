// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMasks.h"

#include "dgtkError.h"
#include "dgtkObjectDocuments.h"

namespace dgtk
{

Masks readMasks(const std::string& path, int width, int height)
{
  const AmodalMasks file = readAmodal(path);
  if (file.width != width || file.height != height)
  {
    throw InputError(path, "size differs from the camera's");
  }
  Masks masks;
  masks.width = width;
  masks.height = height;
  for (const MaskRecord& record : file.masks)
  {
    std::vector<char>& mask = masks.byId[record.id];
    if (!mask.empty())
    {
      throw InputError(path, "has two masks of object " + std::to_string(record.id));
    }
    mask.assign(std::size_t(width) * height, 0);
    std::size_t at = 0; // columns from left to right, each from top to bottom
    char inside = 0;
    for (const std::uint64_t count : record.counts)
    {
      for (const std::size_t end = at + count; at < end; ++at)
      {
        mask[at % height * width + at / height] = inside;
      }
      inside = inside == 0 ? 1 : 0;
    }
  }
  return masks;
}

} // namespace dgtk
