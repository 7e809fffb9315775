// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkMasks.h"

#include <algorithm>

namespace dgtk
{

namespace
{
const std::vector<std::string> idSuffixes{ ".npy", ".png", ".ppm" };

using PixelCheck = std::function<void(int, int, Meter&)>;

Meter everyPixel(Picture& picture, const PixelCheck& check)
{
  return meterRows(picture.pool(), picture.height(), 0,
    [&](int y, Meter& row)
    {
      for (int x = 0; x < picture.width(); ++x)
      {
        check(x, y, row);
      }
    });
}

const ObjectRecord* recordOf(const Dataset& dataset, std::uint32_t id)
{
  const auto found = std::find_if(
    dataset.objects().begin(), dataset.objects().end(), [&](const ObjectRecord& object) { return object.id == id; });
  return found == dataset.objects().end() ? nullptr : &*found;
}

/// Objects whose surfaces a ray meets, sorted.
std::vector<std::uint32_t> objectsAlong(const Sight& sight, const Eigen::Vector2d& pixel)
{
  std::vector<Hit> hits;
  std::vector<double> depths;
  sight.surfaces(pixel, hits, depths);
  std::vector<std::uint32_t> ids;
  ids.reserve(hits.size());
  for (const Hit& hit : hits)
  {
    ids.push_back(hit.object);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

bool contains(const std::vector<std::uint32_t>& ids, std::uint32_t id)
{
  return std::binary_search(ids.begin(), ids.end(), id);
}

/// A mask against all surfaces along the rays; where a silhouette is within EdgeReach, both are right. What `labels`
/// shows is inside by definition; whether the label is right is the check of the objects.
void checkMasks(
  Picture& picture, const std::string& file, const Masks& masks, const PicturePointer& labels, Results& results)
{
  const std::size_t objects = picture.sight().state().instances.size();
  const auto isOpen = [&](int x, int y, std::uint32_t id, bool found)
  {
    if (found && labels && labels->id(x, y) == id)
    {
      return true;
    }
    for (int i = 0; i < 8; ++i)
    {
      constexpr double eighth = 0.78539816339744831;
      const Eigen::Vector2d offset(std::cos(i * eighth), std::sin(i * eighth));
      if (contains(objectsAlong(picture.sight(x, y), centreOf(x, y) + edgeReach * offset), id) == found)
      {
        return true;
      }
    }
    const std::vector<Hit> nearby = picture.nearby(x, y);
    return found && std::any_of(nearby.begin(), nearby.end(), [&](const Hit& hit) { return hit.object == id; });
  };
  results.add({ "amodal", "", { file } },
    everyPixel(picture,
      [&](int x, int y, Meter& meter)
      {
        const std::vector<std::uint32_t> along = objectsAlong(picture.sight(x, y), centreOf(x, y));
        for (std::uint32_t id = 1; id <= objects; ++id)
        {
          const bool found = masks.inside(id, x, y);
          if (found != contains(along, id) && meter.Bad < usualPatience && isOpen(x, y, id, found))
          {
            meter.skip();
            continue;
          }
          meter.equal(found == contains(along, id),
            [&]
            {
              return Offender{ file, x, y, "object " + std::to_string(id) + (found ? " inside" : " outside"),
                found ? "outside" : "inside" };
            });
        }
      }));
}
} // namespace

void checkPartition(Picture& picture, Results& results)
{
  const Dataset& dataset = picture.dataset();
  const PicturePointer objects = picture.quietly([&] { return picture.ids("objects"); });
  if (objects)
  {
    results.add({ "objects", "", { objects->file() } },
      everyPixel(picture,
        [&](int x, int y, Meter& meter)
        {
          const std::uint32_t id = objects->id(x, y);
          meter.equal(id == 0 || recordOf(dataset, id),
            [&] { return objects->offender(x, y, std::to_string(id), "an id of objects.json"); });
        }));
  }
  for (const std::string& suffix : idSuffixes)
  {
    const PicturePointer classes = objects ? picture.image("classes", { suffix }) : nullptr;
    if (classes)
    {
      results.add({ "classes", "", { classes->file() } },
        everyPixel(picture,
          [&](int x, int y, Meter& meter)
          {
            const ObjectRecord* record = recordOf(dataset, objects->id(x, y));
            const std::uint32_t expected = record ? record->classId : 0;
            const std::uint32_t found = classes->id(x, y);
            meter.equal(found == expected,
              [&] { return classes->offender(x, y, std::to_string(found), std::to_string(expected)); });
          }));
    }
  }
  const std::string file = dataset.find(picture.camera(), "amodal", picture.frame(), { ".json" });
  if (file.empty())
  {
    return;
  }
  const Masks masks = readMasks(dataset.absolute(file), picture.width(), picture.height());
  if (objects)
  {
    results.add({ "visible within amodal", "", { file } },
      everyPixel(picture,
        [&](int x, int y, Meter& meter)
        {
          const std::uint32_t id = objects->id(x, y);
          meter.equal(id == 0 || masks.inside(id, x, y),
            [&] {
              return Offender{ file, x, y, "object " + std::to_string(id) + " outside", "inside, as it is visible" };
            });
        }));
  }
  checkMasks(picture, file, masks, objects, results);
}

} // namespace dgtk
