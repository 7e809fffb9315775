// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCocoAnnotations.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkRunLengths.h"

#include <algorithm>

namespace dgtk
{

namespace
{
using coco::Json;

const ChoiceOption& masks()
{
  static const ChoiceOption row(
    "masks", { "rle", "polygon" }, "masks as run lengths, or as polygons where an object has no hole");
  return row;
}

Json segmentationOf(const RunLengths& mask, bool polygons)
{
  const std::vector<std::vector<double>> loops = polygons ? polygonsOf(mask) : std::vector<std::vector<double>>();
  return loops.empty() ? Json{ { "size", { mask.height, mask.width } }, { "counts", mask.compressed() } } : Json(loops);
}

/// A class with keypoints.
const ClassRecord* pointedClass(const DatasetView& dataset, std::uint32_t id)
{
  const auto found = std::find_if(dataset.classes().begin(), dataset.classes().end(),
    [id](const ClassRecord& one) { return one.id == id && !one.keypoints.empty(); });
  return found == dataset.classes().end() ? nullptr : &*found;
}

/// The classes that have keypoints, as COCO's categories.
Json pointedCategories(const DatasetView& dataset)
{
  Json categories = Json::array();
  for (Json& category : coco::categoriesOf(dataset))
  {
    if (const ClassRecord* one = pointedClass(dataset, category["id"].get<std::uint32_t>()))
    {
      category["keypoints"] = one->keypoints;
      category["skeleton"] = one->skeleton;
      categories.push_back(category);
    }
  }
  return categories;
}

/// x, y, v of every keypoint of the class: v is 2 for visible, 1 for hidden; 0, 0, 0 for what is not in the image.
void addKeypoints(Json& annotation, const BoxRecord& box, const ClassRecord& one)
{
  Json numbers = Json::array();
  int labelled = 0;
  for (const std::string& name : one.keypoints)
  {
    const auto found = std::find_if(
      box.keypoints.begin(), box.keypoints.end(), [&](const KeypointRecord& point) { return point.name == name; });
    const int seen = found == box.keypoints.end() ? 0 : found->visibility;
    const int code = seen == 1 ? 2 : seen == 2 || seen == 3 ? 1 : 0;
    const bool there = code > 0 && found->pixel;
    constexpr double half = 0.5; // COCO's keypoints are whole numbers at pixel centres
    numbers.push_back(there ? found->pixel->x() - half : 0);
    numbers.push_back(there ? found->pixel->y() - half : 0);
    numbers.push_back(there ? code : 0);
    labelled += there;
  }
  annotation["keypoints"] = numbers;
  annotation["num_keypoints"] = labelled;
}

class CocoExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &masks() }; }

  bool joinsScenes() const override { return true; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "objects", "boxes", "amodal" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireEverywhere(dataset, exported::color().of(options), "coco", { "png" });
    for (const char* layer : { "objects", "boxes", "amodal" })
    {
      requireEverywhere(dataset, layer, "coco");
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "boxes", "[x, y, width, height], pixels from the image's corner" },
      { "pixel_centre", "(0.5, 0.5); keypoints have integer centres: 0.5 less" }, { "masks", masks().of(options) } };
    const auto names = safeNamesOf(dataset);
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      const std::vector<std::uint32_t> shots = shotsIn(dataset, split);
      plan.series.push_back({ shots.size(), [&dataset, shots, split, names, options](std::size_t i)
        { return item(dataset, dataset.shots()[shots[i]], split.name, *names, options); } });
      plan.documents.push_back(coco::document(dataset, "annotations/instances_" + split.name + ".json", split.name,
        "annotations", coco::categoriesOf(dataset)));
      const Json pointed = pointedCategories(dataset);
      if (!pointed.empty())
      {
        plan.documents.push_back(coco::document(
          dataset, "annotations/person_keypoints_" + split.name + ".json", split.name, "keypoints", pointed));
      }
    }
    return plan;
  }

private:
  static ExportItem item(const DatasetView& dataset, const DatasetShot& shot, const std::string& split,
    const SafeNames& names, const OptionValues& options)
  {
    const std::string file = coco::pictureName(shot, names, pictureExtension(options));
    const std::string path = split + "/" + file;
    return { { path },
      [&dataset, &shot, split, file, path, options](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), path, options);
        sink.note("images:" + split, coco::imageText(dataset, shot, file));
        noteAnnotations(sink, dataset, shot, split, masks().of(options) == "polygon");
      },
      { { shot.name(), shot.frame(), path } } };
  }

  static void noteAnnotations(
    ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& split, bool polygons)
  {
    const std::map<std::uint32_t, RunLengths> visible = masksOf(dataset.read(shot, "objects").pixels);
    const AmodalMasks whole = dataset.amodal(shot);
    for (const BoxRecord& box : dataset.boxes(shot))
    {
      const auto mask = visible.find(box.id);
      const auto amodal =
        std::find_if(whole.masks.begin(), whole.masks.end(), [&](const MaskRecord& one) { return one.id == box.id; });
      if (mask == visible.end() || amodal == whole.masks.end())
      {
        continue; // without a visible pixel there is no annotation
      }
      Json annotation = coco::annotationOf(dataset, shot, box.id, mask->second);
      annotation["segmentation"] = segmentationOf(mask->second, polygons);
      const RunLengths all{ whole.width, whole.height, amodal->counts };
      annotation["amodal_segmentation"] = segmentationOf(all, false);
      annotation["amodal_bbox"] = coco::boxOf(all);
      annotation["visible_fraction"] = double(box.pixelsVisible) / double(box.pixelsAmodal);
      sink.note("annotations:" + split, coco::textOf(annotation));
      if (const ClassRecord* one = pointedClass(dataset, annotation["category_id"].get<std::uint32_t>()))
      {
        addKeypoints(annotation, box, *one);
        sink.note("keypoints:" + split, coco::textOf(annotation));
      }
    }
  }
};
} // namespace

std::unique_ptr<Exporter> makeCocoExporter() { return std::make_unique<CocoExporter>(); }

} // namespace dgtk
