// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkRunLengths.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace dgtk
{

namespace
{
constexpr const char* yoloName = "yolo";

const ChoiceOption& labels()
{
  static const ChoiceOption row(
    "labels", { "boxes", "segments", "poses", "oriented" }, "what the labels of YOLO are; poses are keypoints");
  return row;
}

/// The names of the keypoints of all classes, each once, in the order of the classes.
std::vector<std::string> keypointNames(const DatasetView& dataset)
{
  std::vector<std::string> names;
  for (const ClassRecord& one : dataset.classes())
  {
    for (const std::string& name : one.keypoints)
    {
      if (std::find(names.begin(), names.end(), name) == names.end())
      {
        names.push_back(name);
      }
    }
  }
  return names;
}

/// Number of a class from 0, as data.yaml lists them.
std::size_t classIndex(const DatasetView& dataset, std::uint32_t id)
{
  const auto found = std::find_if(
    dataset.classes().begin(), dataset.classes().end(), [id](const ClassRecord& one) { return one.id == id; });
  return std::size_t(found - dataset.classes().begin());
}

/// The corners of a convex polygon around points, counter-clockwise where y is up (Andrew's monotone chain).
std::vector<Eigen::Vector2d> hullOf(std::vector<Eigen::Vector2d> points)
{
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b)
  { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); };
  std::sort(points.begin(), points.end(), before);
  std::vector<Eigen::Vector2d> hull;
  for (const bool back : { false, true })
  {
    const std::size_t start = hull.size();
    for (const Eigen::Vector2d& point : points)
    {
      const auto turns = [&]
      {
        const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2];
        const Eigen::Vector2d b = point - hull.back();
        return a.x() * b.y() - a.y() * b.x() > 0;
      };
      while (hull.size() >= start + 2 && !turns())
      {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    if (!back)
    {
      std::reverse(points.begin(), points.end());
    }
  }
  return hull;
}

/// The four corners of the smallest rectangle around the pixels of a mask; one of its sides is one of their hull's.
std::vector<double> rectangleOf(const RunLengths& mask)
{
  std::vector<Eigen::Vector2d> corners;
  for (const std::vector<double>& loop : bordersOf(mask))
  {
    for (std::size_t i = 0; i < loop.size(); i += 2)
    {
      corners.emplace_back(loop[i], loop[i + 1]);
    }
  }
  const std::vector<Eigen::Vector2d> hull = hullOf(corners);
  double smallest = std::numeric_limits<double>::infinity();
  std::vector<double> best;
  for (std::size_t i = 0; i < hull.size(); ++i)
  {
    const Eigen::Vector2d along = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    const Eigen::Vector2d across(-along.y(), along.x());
    Eigen::Vector2d least(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
    Eigen::Vector2d most = -least;
    for (const Eigen::Vector2d& point : hull)
    {
      const Eigen::Vector2d place(point.dot(along), point.dot(across));
      least = least.cwiseMin(place);
      most = most.cwiseMax(place);
    }
    const double area = (most - least).prod();
    if (area < smallest)
    {
      smallest = area;
      best.clear();
      for (const auto& [u, v] : { std::pair{ least.x(), least.y() }, std::pair{ most.x(), least.y() },
             std::pair{ most.x(), most.y() }, std::pair{ least.x(), most.y() } })
      {
        const Eigen::Vector2d corner = u * along + v * across;
        best.insert(best.end(), { corner.x(), corner.y() });
      }
    }
  }
  return best;
}

class YoloExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &labels() }; }

  bool joinsScenes() const override { return true; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "objects", "boxes" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    if (labels().of(options) == "poses" && keypointNames(dataset).empty())
    {
      throw UsageError("labels: no class of the dataset names keypoints, which poses are");
    }
    requireEverywhere(dataset, exported::color().of(options), yoloName, { "png" });
    requireEverywhere(dataset, "objects", yoloName);
    requireEverywhere(dataset, "boxes", yoloName);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "places", "shares of width and height from the image's corner" },
      { "classes", "from 0, in the order of data.yaml" }, { "lines", "objects with a visible pixel, by id" },
      { "labels", labels().of(options) } };
    const std::vector<DatasetSplit> splits = splitsOf(dataset, options, "train");
    checkKeys(splits);
    for (const DatasetSplit& split : splits)
    {
      const auto item = [&dataset, names = safeNamesOf(dataset), part = split.name, options](
                          const DatasetShot& shot, std::size_t)
      {
        const std::string stem = part + '/' + names->known(shot.name()) + '_' + padded(shot.frame(), 6);
        return named(shot, itemOf(dataset, shot, stem, options));
      };
      plan.series.push_back(seriesOf(dataset, shotsIn(dataset, split), item));
    }
    plan.documents.push_back({ { "data.yaml" },
      [&dataset, splits, options](ExportSink& sink) { sink.write("data.yaml", yamlOf(dataset, splits, options)); } });
    return plan;
  }

private:
  /// Parts are keys of data.yaml beside its own.
  static void checkKeys(const std::vector<DatasetSplit>& splits)
  {
    const std::set<std::string> own = { "path", "names", "nc", "kpt_shape", "flip_idx", "download" };
    for (const DatasetSplit& split : splits)
    {
      if (own.count(split.name) > 0)
      {
        throw UsageError("split: data.yaml says something else under the name " + quoted(split.name));
      }
    }
  }

  static std::string yamlOf(
    const DatasetView& dataset, const std::vector<DatasetSplit>& splits, const OptionValues& options)
  {
    std::string text; // without a path folders are beside the file
    const auto named = [&](const std::string& name)
    { return std::any_of(splits.begin(), splits.end(), [&](const DatasetSplit& one) { return one.name == name; }); };
    for (const char* name : { "train", "val" }) // both have to be there
    {
      text += std::string(name) + ": images/" + (named(name) ? name : splits.front().name) + '\n';
    }
    for (const DatasetSplit& split : splits)
    {
      text +=
        split.name == "train" || split.name == "val" ? "" : quotedText(split.name) + ": images/" + split.name + '\n';
    }
    if (labels().of(options) == "poses")
    {
      text += "kpt_shape: [" + std::to_string(keypointNames(dataset).size()) + ", 3]\n";
    }
    text += dataset.classes().empty() ? "names: {}\n" : "names:\n";
    for (std::size_t i = 0; i < dataset.classes().size(); ++i)
    {
      text += "  " + std::to_string(i) + ": " + quotedText(namedClass(dataset.classes()[i].name)) + '\n';
    }
    return text;
  }

  static ExportItem itemOf(
    const DatasetView& dataset, const DatasetShot& shot, const std::string& stem, const OptionValues& options)
  {
    const std::string picture = "images/" + stem + '.' + pictureExtension(options);
    const std::string text = "labels/" + stem + ".txt";
    return { { picture, text }, [&dataset, &shot, options, picture, text](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), picture, options);
        sink.write(text, labelsOf(dataset, shot, labels().of(options)));
      } };
  }

  static std::string labelsOf(const DatasetView& dataset, const DatasetShot& shot, const std::string& kind)
  {
    const std::map<std::uint32_t, RunLengths> masks = masksOf(dataset.read(shot, "objects").pixels);
    const std::vector<std::string> names = keypointNames(dataset);
    std::string text;
    for (const BoxRecord& box : dataset.boxes(shot))
    {
      const auto mask = masks.find(box.id);
      const ObjectRecord* object = dataset.object(box.id);
      if (mask == masks.end() || !object || (kind == "poses" && !isPointed(dataset, object->classId)))
      {
        continue;
      }
      std::vector<double> places = kind == "segments"   ? joinedBorder(mask->second)
                                   : kind == "oriented" ? rectangleOf(mask->second)
                                                        : std::vector<double>();
      if (places.empty())
      {
        const Eigen::Vector4d b = mask->second.box();
        places = { b[0] + b[2] / 2, b[1] + b[3] / 2, b[2], b[3] };
      }
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        places[i] /= i % 2 == 0 ? shot.camera.width : shot.camera.height;
      }
      if (kind == "poses")
      {
        addKeypoints(places, box, names, shot.camera);
      }
      text += std::to_string(classIndex(dataset, object->classId)) + ' ' + numbersLine(places) + '\n';
    }
    return text;
  }

  static bool isPointed(const DatasetView& dataset, std::uint32_t id)
  {
    return std::any_of(dataset.classes().begin(), dataset.classes().end(),
      [id](const ClassRecord& one) { return one.id == id && !one.keypoints.empty(); });
  }

  /// x, y, v of every name: v is 2 for visible, 1 for hidden; 0 0 0 for what is not in the image.
  static void addKeypoints(std::vector<double>& places, const BoxRecord& box, const std::vector<std::string>& names,
    const CameraRecord& camera)
  {
    for (const std::string& name : names)
    {
      const auto found = std::find_if(
        box.keypoints.begin(), box.keypoints.end(), [&](const KeypointRecord& point) { return point.name == name; });
      const int seen = found == box.keypoints.end() || !found->pixel ? 0 : found->visibility;
      const int code = seen == 1 ? 2 : seen == 2 || seen == 3 ? 1 : 0;
      const Eigen::Vector2d pixel = code > 0 ? *found->pixel : Eigen::Vector2d(0, 0);
      places.insert(places.end(), { pixel.x() / camera.width, pixel.y() / camera.height, double(code) });
    }
  }
};
} // namespace

std::unique_ptr<Exporter> makeYoloExporter() { return std::make_unique<YoloExporter>(); }

} // namespace dgtk
