// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMasks.h"

#include "dgtkError.h"
#include "dgtkJsonFile.h"

namespace dgtk
{

Masks readMasks(const std::string& path, int width, int height)
{
  const nlohmann::json document = readJsonFile(path);
  return useJson(path,
    [&]
    {
      Masks masks;
      masks.width = document.at("width").get<int>();
      masks.height = document.at("height").get<int>();
      if (masks.width != width || masks.height != height)
      {
        throw InputError(path, 0, "size differs from the camera's");
      }
      const std::size_t pixels = std::size_t(width) * height;
      for (const nlohmann::json& entry : document.at("masks"))
      {
        std::vector<char>& mask = masks.byId[entry.at("id").get<std::uint32_t>()];
        mask.assign(pixels, 0);
        std::size_t at = 0; // columns from left to right, each from top to bottom
        char inside = 0;
        for (const nlohmann::json& count : entry.at("counts"))
        {
          for (auto n = count.get<std::uint64_t>(); n > 0; --n, ++at)
          {
            if (at == pixels)
            {
              throw InputError(path, 0, "a mask is longer than the image");
            }
            mask[at % height * width + at / height] = inside;
          }
          inside = inside == 0 ? 1 : 0;
        }
        if (at != pixels)
        {
          throw InputError(path, 0, "a mask ends before the image");
        }
      }
      return masks;
    });
}

} // namespace dgtk
