// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportSeries.h"
#include "dgtkKitti.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"
#include "dgtkUprightBox.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr const char* kittiObjectName = "kitti-object";
constexpr double upright = 1e-6; ///< radians that rounding may tilt a box
constexpr double degree = pi / 180;

const ChoiceOption& tilt()
{
  static const ChoiceOption row("tilt", { "refuse", "fit" },
    "boxes that are not upright in the camera: no export, or upright ones of their size, centre and nearest turn");
  return row;
}
const ChoiceOption& front()
{
  static const ChoiceOption row(
    "front", "AXIS", { "x", "-x", "y", "-y", "z", "-z" }, "the axis of objects that looks ahead");
  return row;
}
const ChoiceOption& labelBoxes()
{
  static const ChoiceOption row(
    "label_boxes", { "amodal", "visible" }, "2D boxes of labels: of all pixels in the image, or of the visible ones");
  return row;
}

bool isLabelled(const BoxRecord& box) { return box.pixelsVisible > 0; }

/// Share of an object's pixels that the image's border cuts off.
double truncationOf(const BoxRecord& box)
{
  return box.pixelsWhole > box.pixelsAmodal ? 1 - double(box.pixelsAmodal) / double(box.pixelsWhole) : 0;
}

/// 0: at most a tenth is hidden, 1: at most a half, 2: more.
int occlusionOf(const BoxRecord& box)
{
  const double hidden = 1 - double(box.pixelsVisible) / double(box.pixelsAmodal);
  return hidden <= 0.1 ? 0 : hidden <= 0.5 ? 1 : 2;
}

/// An angle from -pi to pi.
double turned(double angle) { return std::remainder(angle, 2 * pi); }

std::string placeOf(const DatasetShot& shot, const BoxRecord& box)
{
  return "object " + quoted(box.name) + " (camera " + quoted(shot.name()) + ", frame " + std::to_string(shot.frame()) +
         ')';
}

UprightBox boxOf(const DatasetShot& shot, const BoxRecord& box, const OptionValues& options)
{
  const std::optional<UprightBox> found = uprightBox(box, front().of(options));
  if (!found)
  {
    throw UsageError(
      std::string(kittiObjectName) + ": " + placeOf(shot, box) + " is sheared, or a line: it has no box");
  }
  if (found->tilt > upright && tilt().of(options) == "refuse")
  {
    throw UsageError("tilt: boxes of " + std::string(kittiObjectName) + " turn about the camera's y alone, " +
                     placeOf(shot, box) + " is " + shortest(std::round(found->tilt / degree * 100) / 100) +
                     " degrees off (expected an upright one, or fit)");
  }
  return *found;
}

/// The type of a label: the class as a word, "Misc" without one.
std::string typeOf(const DatasetView& dataset, const BoxRecord& box)
{
  SafeNames names;
  names.reserve("DontCare"); // KITTI's own, which evaluators pass over
  for (const ClassRecord& one : dataset.classes())
  {
    names.of(one.name);
  }
  return box.objectClass.empty() ? "Misc" : names.of(box.objectClass);
}

class KittiObjectExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &tilt(), &front(), &labelBoxes() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "boxes" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requirePng(options, kittiObjectName);
    requirePinholes(dataset, kittiObjectName);
    dataset.metres();
    requireEverywhere(dataset, exported::color().of(options), kittiObjectName, { "png" });
    requireEverywhere(dataset, "boxes", kittiObjectName, { "json" });
    for (const DatasetShot& shot : dataset.shots())
    {
      for (const BoxRecord& box : dataset.boxes(shot))
      {
        if (isLabelled(box))
        {
          boxOf(shot, box, options);
        }
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = kitti::conventions(dataset);
    plan.conventions.push_back({ "boxes", "pixels from 0, the last one included" });
    plan.conventions.push_back({ "location", "centre of the bottom face; rotation_y 0 looks along x" });
    plan.conventions.push_back({ "truncated", "share of the pixels that the image's border cuts off" });
    plan.conventions.push_back({ "occluded", "0: at most 0.1 of the pixels in the image are hidden, 1: 0.5, 2: more" });
    plan.series.push_back({ dataset.shots().size(), [&dataset, options](std::size_t i)
      { return named(dataset.shots()[i], item(dataset, dataset.shots()[i], options)); } });
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      plan.documents.push_back({ { "ImageSets/" + split.name + ".txt" }, [&dataset, split](ExportSink& sink)
        {
          const std::unique_ptr<ExportFile> file = sink.open("ImageSets/" + split.name + ".txt");
          for (const std::uint32_t shot : shotsIn(dataset, split))
          {
            file->write(numberOf(dataset.shots()[shot]) + '\n');
          }
          file->finish();
        } });
    }
    return plan;
  }

private:
  static std::string numberOf(const DatasetShot& shot) { return padded(static_cast<int>(shot.number), 6); }

  static ExportItem item(const DatasetView& dataset, const DatasetShot& shot, const OptionValues& options)
  {
    const std::string number = numberOf(shot);
    const std::string picture = "training/image_2/" + number + ".png";
    const std::string label = "training/label_2/" + number + ".txt";
    const std::string calib = "training/calib/" + number + ".txt";
    return { { picture, label, calib }, [&dataset, &shot, options, picture, label, calib](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
        sink.write(calib, calibration(shot), { "", &shot, {} });
        LayerRounding tilts{ "boxes", "degrees of tilt", 0, 0, 0 };
        std::string text;
        for (const BoxRecord& box : dataset.boxes(shot))
        {
          if (isLabelled(box))
          {
            const UprightBox solid = boxOf(shot, box, options);
            const double off = solid.tilt > upright ? solid.tilt / degree : 0;
            tilts.largest = std::max(tilts.largest, off);
            ++tilts.values;
            text += typeOf(dataset, box) + ' ' + labelNumbers(dataset, box, solid, options) + '\n';
          }
        }
        sink.write(label, text, { "", &shot, {} });
        sink.rounding(tilts);
      } };
  }

  static std::string labelNumbers(
    const DatasetView& dataset, const BoxRecord& box, const UprightBox& solid, const OptionValues& options)
  {
    const Eigen::Vector4d flat = labelBoxes().of(options) == "visible" ? *box.visible : *box.amodal;
    const double metres = dataset.metres();
    const Eigen::Vector3d place = solid.bottom * metres;
    return numbersLine(
      { truncationOf(box), double(occlusionOf(box)), turned(solid.yaw - portable::atan2(place.x(), place.z())), flat[0],
        flat[1], flat[2] - 1, flat[3] - 1, solid.height * metres, solid.width * metres, solid.length * metres,
        place.x(), place.y(), place.z(), turned(solid.yaw) });
  }

  static std::string calibration(const DatasetShot& shot)
  {
    const std::string P = kitti::projectionLine(shot.camera, 0);
    std::string text;
    for (const char* name : { "P0: ", "P1: ", "P2: ", "P3: " })
    {
      text += name + P + '\n';
    }
    return text + "R0_rect: 1 0 0 0 1 0 0 0 1\nTr_velo_to_cam: " + kitti::scannerLine() +
           "\nTr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0\n";
  }
};
} // namespace

std::unique_ptr<Exporter> makeKittiObjectExporter() { return std::make_unique<KittiObjectExporter>(); }

} // namespace dgtk
