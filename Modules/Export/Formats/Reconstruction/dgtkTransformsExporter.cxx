// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkLayerFile.h"
#include "dgtkMovingObjects.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
using Json = nlohmann::ordered_json;
constexpr const char* transformsName = "transforms";
constexpr int mostBoxScale = 128; ///< that instant-ngp takes

const NumbersOption& depthStep()
{
  static const NumbersOption row("depth_step", "X", 1, 0,
    "a code of the depth maps, in scene units; default a millimetre; 0.001, as nerfstudio has it, of unknown units");
  return row;
}

double stepOf(const DatasetView& dataset, const OptionValues& options)
{
  constexpr double usual = 0.001; ///< metres
  const std::vector<double> given = depthStep().of(options);
  return !given.empty() ? given[0] : dataset.knowsMetres() ? usual / dataset.metres() : usual;
}

[[noreturn]] void refuse(const CameraRecord& camera, const std::string& what)
{
  throw UsageError(std::string(transformsName) + ": camera " + quoted(camera.name) + " has " + what +
                   ", which the format cannot say; render a twin of it");
}

void requireSayable(const CameraRecord& camera)
{
  constexpr std::ptrdiff_t most = 4;
  const std::vector<double> k = distortionOf(camera);
  if (camera.model != "pinhole" && camera.model != "fisheye")
  {
    refuse(camera, "the model " + camera.model);
  }
  if (camera.rollingShutter.duration != 0)
  {
    refuse(camera, "a rolling shutter");
  }
  if (intrinsicsOf(camera, PixelCentre::Half)(0, 1) != 0)
  {
    refuse(camera, "a skew");
  }
  if (k.size() > most && std::any_of(k.begin() + most, k.end(), [](double c) { return c != 0; }))
  {
    refuse(camera, "a distortion of more than k1 k2 p1 p2");
  }
}

/// The keys of a camera, of the whole document or of a frame.
Json lensOf(const CameraRecord& camera)
{
  const Eigen::Matrix3d K = intrinsicsOf(camera, PixelCentre::Half);
  Json lens{ { "w", camera.width }, { "h", camera.height }, { "fl_x", K(0, 0) }, { "fl_y", K(1, 1) }, { "cx", K(0, 2) },
    { "cy", K(1, 2) }, { "camera_angle_x", 2 * portable::atan(camera.width / (2 * K(0, 0))) },
    { "camera_angle_y", 2 * portable::atan(camera.height / (2 * K(1, 1))) } };
  std::vector<double> k = distortionOf(camera);
  k.resize(4);
  const bool fisheye = camera.model == "fisheye";
  lens["k1"] = k[0];
  lens["k2"] = k[1];
  lens[fisheye ? "k3" : "p1"] = k[2];
  lens[fisheye ? "k4" : "p2"] = k[3];
  return lens;
}

/// Names of the files of a picture.
struct Names
{
  std::string picture;
  std::string depth;
  std::string mask;    ///< "" for none; black is left out (nerfstudio)
  std::string dynamic; ///< likewise; white is left out (instant-ngp)
};

class TransformsExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &depthStep() }; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options), "objects", "tracks" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    const CameraRecord& first = dataset.shots().front().camera;
    for (const DatasetShot& shot : dataset.shots())
    {
      requireSayable(shot.camera);
      if (shot.camera.model != first.model)
      {
        throw UsageError(std::string(transformsName) + ": cameras " + quoted(first.name) + " and " +
                         quoted(shot.name()) + " have models of their own (" + first.model + ", " + shot.camera.model +
                         "), and a document has one; name some with cameras");
      }
    }
    requireUsualSplits(dataset, options, transformsName);
    requireEverywhere(dataset, exported::color().of(options), transformsName, { "png" });
    requireEverywhere(dataset, exported::depth().of(options), transformsName);
    requireEverywhere(dataset, "objects", transformsName);
    requireEverywhere(dataset, "tracks", transformsName, { "npy" });
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "(0.5, 0.5)" }, { "axes", "x right, y up, z back; world from camera" },
      { "depth", "z, codes of depth_step scene units, 0 for none" },
      { "masks", "mask_path: black moves; dynamic_mask_*.png: white moves" } };
    const bool several = dataset.frames().size() > 1;
    const std::vector<std::uint32_t> moving = several ? movingObjects(dataset) : std::vector<std::uint32_t>();
    const bool same = haveOneLens(dataset);
    const auto item = [&dataset, safe = safeNamesOf(dataset), moving, same, options](std::size_t i)
    {
      const DatasetShot& shot = dataset.shots()[i];
      return named(shot, itemOf(dataset, shot, namesOf(shot, *safe, !moving.empty(), options), moving, !same, options));
    };
    plan.series.push_back({ dataset.shots().size(), item });
    plan.documents.push_back(points(dataset));
    const double size = sizeOf(dataset);
    plan.documents.push_back(document(dataset, same, size, options));
    if (2 * size > mostBoxScale)
    {
      plan.warnings.push_back(
        "transforms.json: aabb_scale is at most " + std::to_string(mostBoxScale) +
        ", and the cube of cameras and points needs " + shortest(std::ceil(2 * size)) +
        ": instant-ngp cuts off what is beyond (bring the scene nearer to 0, or make it smaller)");
    }
    return plan;
  }

private:
  static bool haveOneLens(const DatasetView& dataset)
  {
    const Json first = lensOf(dataset.shots().front().camera);
    return std::all_of(dataset.shots().begin(), dataset.shots().end(),
      [&](const DatasetShot& shot) { return lensOf(shot.camera) == first; });
  }

  static Names namesOf(const DatasetShot& shot, const SafeNames& safe, bool masked, const OptionValues& options)
  {
    const std::string stem = stemOf(shot, safe);
    Names names{ pictureOf(shot, safe, options), "depth/" + stem + ".png", "", "" };
    if (masked)
    {
      names.mask = "masks/" + stem + ".png";
      names.dynamic = "images/dynamic_mask_" + stem + ".png";
    }
    return names;
  }

  static std::string stemOf(const DatasetShot& shot, const SafeNames& safe)
  {
    return safe.known(shot.name()) + '_' + padded(shot.frame(), 6);
  }

  static std::string pictureOf(const DatasetShot& shot, const SafeNames& safe, const OptionValues& options)
  {
    return "images/" + stemOf(shot, safe) + '.' + pictureExtension(options);
  }

  static ExportItem itemOf(const DatasetView& dataset, const DatasetShot& shot, const Names& names,
    const std::vector<std::uint32_t>& moving, bool ownLens, const OptionValues& options)
  {
    ExportItem item{ { names.picture, names.depth }, {} };
    if (!names.mask.empty())
    {
      item.files.insert(item.files.end(), { names.mask, names.dynamic });
    }
    item.write = [&dataset, &shot, names, moving, ownLens, options](ExportSink& sink)
    {
      LinearCode code;
      code.scale = stepOf(dataset, options);
      code.unit = "scene units";
      writePicture(sink, dataset, shot, exported::color().of(options), names.picture, options);
      writeCodedPng(sink, dataset, shot, exported::depth().of(options), names.depth, code, options);
      Json frame{ { "file_path", names.picture }, { "depth_path", names.depth }, { "depth_file_path", names.depth } };
      if (!names.mask.empty())
      {
        writeMovingMask(sink, dataset, shot, names.mask, moving, true);
        writeMovingMask(sink, dataset, shot, names.dynamic, moving, false);
        frame["mask_path"] = names.mask;
      }
      if (ownLens)
      {
        frame.update(lensOf(shot.camera));
      }
      frame["transform_matrix"] = matrixRows(worldFromCameraGL(shot.camera));
      sink.note("frames", frame.dump());
    };
    return item;
  }

  /// Points of surfaces that stay, as float32, to begin a reconstruction with.
  static ExportItem points(const DatasetView& dataset)
  {
    return { { "points.ply" }, [&dataset](ExportSink& sink)
      {
        std::string rows;
        std::size_t count = 0;
        FloatRounder rounder(0, "tracks", "scene units");
        for (const TrackPoint& point : trackPointsBut(dataset, movingObjects(dataset)))
        {
          if (point.isStatic)
          {
            ++count;
            for (const double x : point.x)
            {
              putLittle(rows, rounder(x));
            }
            rows.append(point.color, point.color + 3);
          }
        }
        std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) + '\n';
        for (const char* axis : { "x", "y", "z" })
        {
          head += std::string("property float ") + axis + '\n';
        }
        for (const char* color : { "red", "green", "blue" })
        {
          head += std::string("property uchar ") + color + '\n';
        }
        sink.write("points.ply", head + "end_header\n" + rows);
        sink.rounding(rounder.account());
      } };
  }

  /// Half the side of the smallest cube around cameras and points, by instant-ngp's own scale of the scene.
  static double sizeOf(const DatasetView& dataset)
  {
    constexpr double usual = 0.33;
    double size = 0;
    for (const DatasetShot& shot : dataset.shots())
    {
      size = std::max(size, cameraFromWorld(shot.camera).inverse().translation.cwiseAbs().maxCoeff());
    }
    for (const TrackPoint& point : dataset.trackPoints())
    {
      size = std::max(size, point.x.cwiseAbs().maxCoeff());
    }
    return usual * size;
  }

  static int boxScale(double size)
  {
    int scale = 1;
    while (scale < mostBoxScale && scale < 2 * size)
    {
      scale *= 2;
    }
    return scale;
  }

  static ExportItem document(const DatasetView& dataset, bool same, double size, const OptionValues& options)
  {
    return { { "transforms.json" }, [&dataset, same, size, options](ExportSink& sink)
      {
        const CameraRecord& first = dataset.shots().front().camera;
        const bool fisheye = first.model == "fisheye";
        Json head{ { "camera_model", fisheye ? "OPENCV_FISHEYE" : "OPENCV" }, { "is_fisheye", fisheye },
          { "aabb_scale", boxScale(size) }, { "enable_depth_loading", true },
          { "integer_depth_scale", stepOf(dataset, options) }, { "ply_file_path", "points.ply" } };
        if (same)
        {
          head.update(lensOf(first));
        }
        const std::string text = head.dump(1);
        const std::unique_ptr<ExportFile> file = sink.open("transforms.json");
        file->write(text.substr(0, text.size() - 2));
        writeSplits(*file, dataset, options);
        file->write(std::string(",\n \"frames\": ["));
        writeNotes(sink, *file, "frames");
        file->write(std::string("\n ]\n}\n"));
        file->finish();
      } };
  }

  /// The pictures of each part, as further keys.
  static void writeSplits(ExportFile& file, const DatasetView& dataset, const OptionValues& options)
  {
    if (exported::split().of(options).empty())
    {
      return;
    }
    const auto safe = safeNamesOf(dataset);
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      file.write(",\n \"" + split.name + "_filenames\": [");
      const char* between = "\n  ";
      for (const std::uint32_t shot : shotsIn(dataset, split))
      {
        file.write(between + quotedText(pictureOf(dataset.shots()[shot], *safe, options)));
        between = ",\n  ";
      }
      file.write(std::string("\n ]"));
    }
  }
};
} // namespace

std::unique_ptr<Exporter> makeTransformsExporter() { return std::make_unique<TransformsExporter>(); }

} // namespace dgtk
