// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include <functional>

namespace dgtk
{

namespace
{
using IdOf = std::function<std::uint32_t(const Hit&)>;

void checkFile(
  Picture& picture, const std::string& layer, const std::string& suffix, const IdOf& idOf, Results& results)
{
  const PicturePointer ids = picture.image(layer, { suffix });
  if (!ids)
  {
    return;
  }
  const Surfaces& surfaces = picture.surfaces();
  const Meter meter = meterRows(picture.pool(), picture.height(), 0,
    [&](int y, Meter& row)
    {
      for (int x = 0; x < picture.width(); ++x)
      {
        const std::size_t i = surfaces.index(x, y);
        const std::uint32_t found = ids->id(x, y);
        // Of a wrong pixel, only the layers that differ from Embree are to blame.
        const bool open = surfaces.marks[i] == Mark::Edge;
        const std::uint32_t expected = idOf(surfaces.hits[i]);
        if (open && found == expected)
        {
          row.skip();
          continue;
        }
        row.equal(
          found == expected, [&] { return ids->offender(x, y, std::to_string(found), std::to_string(expected)); });
      }
    });
  results.add({ layer, "", { ids->file() } }, meter);
}
} // namespace

void checkObjects(Picture& picture, Results& results)
{
  for (const char* suffix : { ".npy", ".png", ".ppm" })
  {
    checkFile(
      picture, "objects", suffix, [](const Hit& hit) { return hit.object; }, results);
    checkFile(
      picture, "parts", suffix, [&](const Hit& hit) { return picture.partId(hit); }, results);
    checkFile(
      picture, "triangles", suffix, [&](const Hit& hit) { return picture.triangleId(hit); }, results);
  }
}

} // namespace dgtk
