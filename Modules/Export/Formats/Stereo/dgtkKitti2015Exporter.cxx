// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportSeries.h"
#include "dgtkKitti.h"
#include "dgtkText.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr const char* kitti2015Name = "kitti2015";
constexpr const char* later = "disparity_forward"; ///< at the next frame, in the pixels of this one

const NamesOption& foreground()
{
  static const NamesOption row(
    "foreground", "CLASSES", "classes of the objects that obj_map shows; the others are 0 (default: all)");
  return row;
}

/// The pair at a frame and at the next one.
struct Sample
{
  const DatasetShot* left = nullptr;
  const DatasetShot* right = nullptr;
  const DatasetShot* nextLeft = nullptr;
  const DatasetShot* nextRight = nullptr;
};

CameraEyes thePair(const DatasetView& dataset)
{
  const std::vector<CameraEyes> pairs = pairsOf(dataset, kitti2015Name);
  if (pairs.size() > 1)
  {
    std::vector<std::string> words;
    words.reserve(pairs.size());
    for (const CameraEyes& one : pairs)
    {
      words.push_back(quoted(one.left) + " and " + quoted(one.right));
    }
    throw UsageError("cameras: " + std::string(kitti2015Name) + " shows one rectified pair; the dataset has several: " +
                     joined(words, "; ") + " (name two cameras)");
  }
  return pairs.front();
}

std::vector<Sample> samplesOf(const DatasetView& dataset)
{
  const CameraEyes pair = thePair(dataset);
  std::vector<Sample> samples;
  for (const DatasetShot* left : dataset.shotsOf(pair.left))
  {
    const Sample one{ left, dataset.shot(pair.right, left->frame()), dataset.shot(pair.left, left->frame() + 1),
      dataset.shot(pair.right, left->frame() + 1) };
    if (one.nextLeft && one.nextRight)
    {
      samples.push_back(one);
    }
  }
  if (samples.empty())
  {
    throw UsageError("frames: " + std::string(kitti2015Name) + " needs two frames that follow each other");
  }
  return samples;
}

std::map<std::uint32_t, std::uint32_t> objectCodes(const DatasetView& dataset, const OptionValues& options)
{
  const std::vector<std::string> classes = foreground().of(options);
  std::vector<std::string> known;
  for (const ClassRecord& one : dataset.classes())
  {
    known.push_back(one.name);
  }
  for (const std::string& name : classes)
  {
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      throw UsageError("foreground: no class " + quoted(name) +
                       (known.empty() ? ": the dataset has none" : " (expected one of " + joined(known, ", ") + ')'));
    }
  }
  std::map<std::uint32_t, std::uint32_t> codes;
  for (const ObjectRecord& object : dataset.objects())
  {
    if (classes.empty() || std::find(classes.begin(), classes.end(), object.objectClass) != classes.end())
    {
      const auto next = static_cast<std::uint32_t>(codes.size() + 1);
      codes[object.id] = next;
    }
  }
  if (codes.size() > 255)
  {
    throw UsageError("foreground: " + std::string(kitti2015Name) + " has codes for 255 objects (found " +
                     std::to_string(codes.size()) + "); name classes");
  }
  return codes;
}

class Kitti2015Exporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &foreground() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "disparity", later, "flow_forward", "objects" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, kitti2015Name);
    requireWhole(options, kitti2015Name);
    dataset.metres();
    objectCodes(dataset, options);
    for (const Sample& one : samplesOf(dataset))
    {
      for (const DatasetShot* shot : { one.left, one.right, one.nextLeft, one.nextRight })
      {
        requireFile(dataset, *shot, exported::color().of(options), kitti2015Name, { "png" });
      }
      for (const char* layer : { "disparity", later, "flow_forward", "objects" })
      {
        requireFile(dataset, *one.left, layer, kitti2015Name);
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = kitti::conventions(dataset);
    plan.conventions.push_back({ "noc", "visibility class 1, of disp_noc_1 of the flow, too; occ: classes 1 to 4" });
    const std::vector<Sample> samples = samplesOf(dataset);
    plan.series.push_back({ samples.size(), [&dataset, samples, options](std::size_t i)
      {
        const std::string number = padded(static_cast<int>(i), 6);
        ExportItem one = item(dataset, samples[i], number, options);
        one.names = namesOf(samples, i, number);
        return one;
      } });
    return plan;
  }

private:
  /// A picture's name is the one of its sample; the last of a run has none and is the second of the one before.
  static std::vector<ExportedName> namesOf(const std::vector<Sample>& samples, std::size_t i, const std::string& number)
  {
    std::vector<ExportedName> names;
    const Sample& one = samples[i];
    const auto add = [&](const DatasetShot* shot, const char* folder, const char* time) {
      names.push_back({ shot->name(), shot->frame(), "training/" + (folder + ('/' + number)) + time });
    };
    add(one.left, "image_2", "_10.png");
    add(one.right, "image_3", "_10.png");
    if (i + 1 == samples.size() || samples[i + 1].left != one.nextLeft)
    {
      add(one.nextLeft, "image_2", "_11.png");
      add(one.nextRight, "image_3", "_11.png");
    }
    return names;
  }

  static ExportItem item(
    const DatasetView& dataset, const Sample& one, const std::string& number, const OptionValues& options)
  {
    const auto path = [number](const char* folder, const char* end)
    { return "training/" + (folder + ('/' + number)) + end; };
    ExportItem item;
    for (const char* picture : { "_10.png", "_11.png" })
    {
      item.files.push_back(path("image_2", picture));
      item.files.push_back(path("image_3", picture));
    }
    for (const char* folder :
      { "disp_noc_0", "disp_occ_0", "disp_noc_1", "disp_occ_1", "flow_noc", "flow_occ", "obj_map" })
    {
      item.files.push_back(path(folder, "_10.png"));
    }
    item.files.push_back("training/calib_cam_to_cam/" + number + ".txt");
    item.write = [&dataset, one, number, options, path](ExportSink& sink)
    {
      const std::string color = exported::color().of(options);
      writePicture(sink, dataset, *one.left, color, path("image_2", "_10.png"), options);
      writePicture(sink, dataset, *one.right, color, path("image_3", "_10.png"), options);
      writePicture(sink, dataset, *one.nextLeft, color, path("image_2", "_11.png"), options);
      writePicture(sink, dataset, *one.nextRight, color, path("image_3", "_11.png"), options);
      const auto disparity = [&](const char* layer, const char* folder, const WantedClasses& classes) {
        writeCodedPng(
          sink, dataset, *one.left, layer, path(folder, "_10.png"), kitti::code256(1, "px"), options, classes);
      };
      disparity("disparity", "disp_noc_0", { { "disparity", seenClasses() } });
      disparity("disparity", "disp_occ_0", { { "disparity", placedClasses() } });
      disparity(later, "disp_noc_1", { { later, seenClasses() }, { "flow_forward", seenClasses() } });
      disparity(later, "disp_occ_1", { { later, placedClasses() } });
      kitti::writeFlow(sink, dataset, *one.left, "flow_forward", path("flow_noc", "_10.png"),
        { { "flow_forward", seenClasses() } }, options);
      kitti::writeFlow(sink, dataset, *one.left, "flow_forward", path("flow_occ", "_10.png"),
        { { "flow_forward", placedClasses() } }, options);
      writeIdPng(sink, dataset, *one.left, "objects", path("obj_map", "_10.png"), objectCodes(dataset, options));
      sink.write("training/calib_cam_to_cam/" + number + ".txt",
        kitti::camToCam(one.left->camera, &one.right->camera, baselineMetres(dataset, *one.left, *one.right)),
        { "", one.left, {} });
    };
    return item;
  }
};
} // namespace

std::unique_ptr<Exporter> makeKitti2015Exporter() { return std::make_unique<Kitti2015Exporter>(); }

} // namespace dgtk
