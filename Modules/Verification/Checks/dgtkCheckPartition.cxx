// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkMasks.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>

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

/// What a row of pixels shows, by their columns: ids of the masks that hold them, sorted.
std::vector<std::vector<std::uint32_t>> masksOfRow(const Masks& masks, int y, std::uint32_t largest)
{
  std::vector<std::vector<std::uint32_t>> ids(static_cast<std::size_t>(masks.width));
  for (auto mask = masks.byId.lower_bound(1); mask != masks.byId.end() && mask->first <= largest; ++mask)
  {
    const auto row = mask->second.begin() + std::ptrdiff_t(y) * masks.width;
    const auto end = row + masks.width;
    for (auto inside = std::find(row, end, 1); inside != end; inside = std::find(inside + 1, end, 1))
    {
      ids[std::size_t(inside - row)].push_back(mask->first);
    }
  }
  return ids;
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
  const auto objects = static_cast<std::uint32_t>(picture.sight().state().instances.size());
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
  const auto judge = [&](int x, int y, const std::vector<std::uint32_t>& inside, Meter& meter)
  {
    const std::vector<std::uint32_t> along = objectsAlong(picture.sight(x, y), centreOf(x, y));
    std::vector<std::uint32_t> differing;
    std::set_symmetric_difference(
      inside.begin(), inside.end(), along.begin(), along.end(), std::back_inserter(differing));
    meter.good(objects - differing.size());
    for (const std::uint32_t id : differing)
    {
      const bool found = contains(inside, id);
      if (meter.Bad < usualPatience && isOpen(x, y, id, found))
      {
        meter.skip();
        continue;
      }
      meter.equal(false,
        [&]
        {
          return Offender{ file, x, y, "object " + std::to_string(id) + (found ? " inside" : " outside"),
            found ? "outside" : "inside" };
        });
    }
  };
  const Meter meter = meterRows(picture.pool(), picture.height(), 0,
    [&](int y, Meter& row)
    {
      const std::vector<std::vector<std::uint32_t>> inside = masksOfRow(masks, y, objects);
      for (int x = 0; x < picture.width(); ++x)
      {
        judge(x, y, inside[std::size_t(x)], row);
      }
    });
  results.add({ "amodal", "", { file } }, meter);
}
} // namespace

void checkPartition(Picture& picture, Results& results)
{
  const Dataset& dataset = picture.dataset();
  std::unordered_map<std::uint32_t, std::uint32_t> classOf; // of an object's id
  for (const ObjectRecord& object : dataset.objects())
  {
    classOf.emplace(object.id, object.classId);
  }
  const PicturePointer objects = picture.quietly([&] { return picture.ids("objects"); });
  if (objects)
  {
    results.add({ "objects", "", { objects->file() } },
      everyPixel(picture,
        [&](int x, int y, Meter& meter)
        {
          const std::uint32_t id = objects->id(x, y);
          meter.equal(id == 0 || classOf.count(id) > 0,
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
            const auto own = classOf.find(objects->id(x, y));
            const std::uint32_t expected = own == classOf.end() ? 0 : own->second;
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
