// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCocoAnnotations.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkLayerColors.h"
#include "dgtkText.h"

#include <algorithm>
#include <array>

namespace dgtk
{

namespace
{
using coco::Json;

const NamesOption& stuff()
{
  static const NamesOption row(
    "stuff", "NAMES", "classes that are stuff: one segment of a picture each; beside those that the dataset says are");
  return row;
}

class CocoPanopticExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &stuff() }; }

  bool joinsScenes() const override { return true; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "objects" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    constexpr std::uint32_t most = 1U << 24U; // of R, G, B
    std::vector<std::string> names;
    for (const ClassRecord& one : dataset.classes())
    {
      names.push_back(one.name);
    }
    for (const std::string& name : stuff().of(options))
    {
      if (std::find(names.begin(), names.end(), name) == names.end())
      {
        throw UsageError("stuff: no class " + quoted(name) + " (expected one of " + joined(names, ", ") + ')');
      }
    }
    for (const auto& [id, code] : segmentIds(dataset, options))
    {
      if (code >= most)
      {
        throw UsageError("coco-panoptic: object " + std::to_string(id) + " has no number of 24 bits");
      }
    }
    requireEverywhere(dataset, exported::color().of(options), "coco-panoptic", { "png" });
    requireEverywhere(dataset, "objects", "coco-panoptic");
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "segments", "R + 256 G + 65536 B; things have their objects' ids, stuff the next ones" },
      { "boxes", "[x, y, width, height], pixels from the image's corner" } };
    const auto names = safeNamesOf(dataset);
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      const std::vector<std::uint32_t> shots = shotsIn(dataset, split);
      plan.series.push_back({ shots.size(), [&dataset, shots, split, names, options](std::size_t i)
        { return item(dataset, dataset.shots()[shots[i]], split.name, *names, options); } });
      plan.documents.push_back(coco::document(dataset, "annotations/panoptic_" + split.name + ".json", split.name,
        "annotations", categoriesOf(dataset, options)));
    }
    return plan;
  }

private:
  static bool isStuff(const ClassRecord& one, const OptionValues& options)
  {
    const std::vector<std::string> named = stuff().of(options);
    return one.thing == false || std::find(named.begin(), named.end(), one.name) != named.end();
  }

  static Json categoriesOf(const DatasetView& dataset, const OptionValues& options)
  {
    Json categories = coco::categoriesOf(dataset);
    for (Json& category : categories)
    {
      for (const ClassRecord& one : dataset.classes())
      {
        if (one.id == category["id"])
        {
          category["isthing"] = isStuff(one, options) ? 0 : 1;
          const Rgb usual = idColor(one.id); // its tools want one of each
          category["color"] = one.color.value_or(std::array<int, 3>{ usual[0], usual[1], usual[2] });
        }
      }
    }
    return categories;
  }

  /// Object id to segment id: things keep theirs, objects of a kind of stuff share one beyond.
  static std::map<std::uint32_t, std::uint32_t> segmentIds(const DatasetView& dataset, const OptionValues& options)
  {
    std::uint32_t next = 0;
    for (const ObjectRecord& object : dataset.objects())
    {
      next = std::max(next, object.id);
    }
    std::map<std::uint32_t, std::uint32_t> ids;
    for (const ClassRecord& one : dataset.classes())
    {
      const bool shared = isStuff(one, options);
      next += shared ? 1 : 0;
      for (const ObjectRecord& object : dataset.objects())
      {
        if (object.classId == one.id)
        {
          ids[object.id] = shared ? next : object.id;
        }
      }
    }
    return ids;
  }

  static ExportItem item(const DatasetView& dataset, const DatasetShot& shot, const std::string& split,
    const SafeNames& names, const OptionValues& options)
  {
    const std::string file = coco::pictureName(shot, names, pictureExtension(options));
    const std::string picture = split + '/' + file;
    const std::string segments = file.substr(0, file.rfind('.')) + ".png";
    const std::string map = "annotations/panoptic_" + split + '/' + segments;
    return { { picture, map },
      [&dataset, &shot, split, file, picture, segments, map, options](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
        const std::map<std::uint32_t, std::uint32_t> ids = segmentIds(dataset, options);
        writeIdPng(sink, dataset, shot, "objects", map, ids, IdBytes::RedLow);
        sink.note("images:" + split, coco::imageText(dataset, shot, file));
        sink.note(
          "annotations:" + split, coco::textOf({ { "image_id", coco::imageIdOf(shot) }, { "file_name", segments },
                                    { "segments_info", segmentsOf(dataset, shot, ids) } }));
      },
      { { shot.name(), shot.frame(), picture } } };
  }

  static Json segmentsOf(
    const DatasetView& dataset, const DatasetShot& shot, const std::map<std::uint32_t, std::uint32_t>& ids)
  {
    struct Segment
    {
      std::uint32_t category = 0;
      std::uint64_t area = 0;
      Eigen::Vector4d box{ 0, 0, 0, 0 }; ///< x0 y0 x1 y1
    };
    std::map<std::uint32_t, Segment> segments;
    for (const auto& [id, mask] : masksOf(dataset.read(shot, "objects").pixels))
    {
      const auto code = ids.find(id);
      if (code == ids.end())
      {
        continue;
      }
      const Eigen::Vector4d box = mask.box();
      const Eigen::Vector4d corners(box[0], box[1], box[0] + box[2], box[1] + box[3]);
      Segment& segment = segments[code->second];
      const Eigen::Vector4d old = segment.area == 0 ? corners : segment.box;
      segment.box << old.head<2>().cwiseMin(corners.head<2>()), old.tail<2>().cwiseMax(corners.tail<2>());
      segment.area += mask.area();
      segment.category = dataset.object(id)->classId;
    }
    Json list = Json::array();
    for (const auto& [id, one] : segments)
    {
      list.push_back({ { "id", id }, { "category_id", one.category }, { "area", one.area },
        { "bbox", { one.box[0], one.box[1], one.box[2] - one.box[0], one.box[3] - one.box[1] } }, { "iscrowd", 0 } });
    }
    return list;
  }
};
} // namespace

std::unique_ptr<Exporter> makeCocoPanopticExporter() { return std::make_unique<CocoPanopticExporter>(); }

} // namespace dgtk
