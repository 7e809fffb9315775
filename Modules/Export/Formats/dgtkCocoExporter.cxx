// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCocoAnnotations.h"
#include "dgtkExport.h"
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

class CocoExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &masks() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "objects", "boxes", "amodal" } };
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "boxes", "[x, y, width, height], pixels from the image's corner" },
      { "pixel_centre", "(0.5, 0.5); keypoints have integer centres: 0.5 less" }, { "masks", masks().of(options) } };
    SafeNames names;
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      for (const DatasetShot& shot : dataset.shots())
      {
        if (split.holds(shot.frame()))
        {
          plan.items.push_back(this->item(dataset, shot, split.name, names, options));
          plan.names.push_back({ shot.name(), shot.frame(), plan.items.back().files[0] });
        }
      }
      plan.documents.push_back(coco::document(dataset, "annotations/instances_" + split.name + ".json", split.name));
    }
    return plan;
  }

private:
  static ExportItem item(const DatasetView& dataset, const DatasetShot& shot, const std::string& split,
    SafeNames& names, const OptionValues& options)
  {
    const std::string file = coco::pictureName(shot, names, pictureExtension(options));
    const std::string path = split + "/" + file;
    return { { path }, [&dataset, &shot, split, file, path, options](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), path, options);
        sink.note("images:" + split, coco::imageText(shot, file));
        for (const Json& annotation : annotationsOf(dataset, shot, masks().of(options) == "polygon"))
        {
          sink.note("annotations:" + split, coco::textOf(annotation));
        }
      } };
  }

  static std::vector<Json> annotationsOf(const DatasetView& dataset, const DatasetShot& shot, bool polygons)
  {
    const std::map<std::uint32_t, RunLengths> visible = masksOf(dataset.read(shot, "objects").pixels);
    const AmodalMasks whole = dataset.amodal(shot);
    std::vector<Json> annotations;
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
      annotations.push_back(annotation);
    }
    return annotations;
  }
};
} // namespace

std::unique_ptr<Exporter> makeCocoExporter() { return std::make_unique<CocoExporter>(); }

} // namespace dgtk
