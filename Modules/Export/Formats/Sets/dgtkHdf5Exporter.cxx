// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkClassedRows.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportFloats.h"
#include "dgtkExportSeries.h"
#include "dgtkHdf5File.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <limits>
#include <set>

namespace dgtk
{

namespace
{
constexpr const char* hdf5Name = "hdf5";
constexpr int hdf5GzipLevel = 4; ///< h5py's own
constexpr float nothingSeen = 1e10F;
using Json = nlohmann::ordered_json;

/// A layer of real numbers, and its key.
struct RealKey
{
  const char* key;
  const char* layer; ///< "": that of the option `depth`
  bool isLength;     ///< in metres
};
constexpr RealKey realKeys[] = { { "depth", "", true }, { "distance", "distance", true },
  { "forward_flow", "flow_forward", false }, { "backward_flow", "flow_backward", false },
  { "disparity", "disparity", false } };

/// A camera of a file, and what follows its keys.
struct Hdf5Eye
{
  const DatasetShot* shot = nullptr;
  std::string suffix;
};

class FrameFile
{
public:
  FrameFile(ExportSink& sink, const DatasetView& dataset, const OptionValues& options)
    : Sink(sink)
    , Dataset(dataset)
    , Options(options)
    , File(hdf5GzipLevel)
  {
  }

  void add(const Hdf5Eye& eye)
  {
    this->addColors(eye);
    for (const RealKey& key : realKeys)
    {
      const std::string layer = *key.layer ? key.layer : exported::depth().of(this->Options);
      if (!this->Dataset.file(*eye.shot, layer).empty() && this->leadsToOne(eye, layer))
      {
        this->addReals(eye, key.key + eye.suffix, layer, key.isLength);
      }
    }
    if (!this->Dataset.file(*eye.shot, "normal").empty())
    {
      this->addNormals(eye);
    }
    if (!this->Dataset.file(*eye.shot, "objectcoords").empty())
    {
      this->addObjectCoordinates(eye);
    }
    this->File.add("instance_attribute_maps" + eye.suffix, this->attributes(this->addIds(eye, "objects", "instance")));
    this->addIds(eye, "classes", "class");
    this->File.add("camera_pose" + eye.suffix, this->pose(eye.shot->camera));
  }

  std::string bytes() const { return this->File.bytes(); }

private:
  using Type = Hdf5File::Type;

  /// Whether the picture that a layer's values lead to is in the export, too.
  bool leadsToOne(const Hdf5Eye& eye, const std::string& layer) const
  {
    if (layer == "disparity")
    {
      return !eye.suffix.empty();
    }
    const int step = layer == "flow_forward" ? 1 : layer == "flow_backward" ? -1 : 0;
    return this->Dataset.shot(eye.shot->name(), eye.shot->frame() + step) != nullptr;
  }

  void addColors(const Hdf5Eye& eye)
  {
    const std::string layer = exported::color().of(this->Options);
    const std::unique_ptr<RowReader> reader = this->Dataset.open(*eye.shot, layer, { "png" });
    const ImageInfo& info = reader->info();
    const bool wide = info.type == PixelType::UInt16;
    this->File.add("colors" + eye.suffix, Type::UInt8, { info.height, info.width, info.channels },
      [&](int y, void* row)
      {
        const Rows rows = reader->read(1);
        for (int i = 0; i < info.width * info.channels; ++i)
        {
          const double value = valueAt(rows, i / info.channels, y, i % info.channels);
          static_cast<std::uint8_t*>(row)[i] = static_cast<std::uint8_t>(wide ? value / 257 + 0.5 : value);
        }
      });
    this->Sink.rounding({ layer, "levels", wide ? 0.5 : 0, std::uint64_t(info.width) * unsigned(info.height), 0 });
  }

  void addReals(const Hdf5Eye& eye, const std::string& key, const std::string& layer, bool isLength)
  {
    ClassedRows rows(this->Dataset, *eye.shot, layer);
    const ImageInfo& info = rows.info();
    const double factor = isLength ? this->Dataset.metres() : 1;
    FloatRounder rounder(
      isLength ? nothingSeen : std::numeric_limits<float>::quiet_NaN(), layer, isLength ? "m" : "px");
    this->File.add(key, Type::Float32, { info.height, info.width, info.channels },
      [&](int, void* row)
      {
        rows.next();
        for (int i = 0; i < info.width * info.channels; ++i)
        {
          const double value = rows.at(i / info.channels, i % info.channels);
          static_cast<float*>(row)[i] = isLength ? rounder.length(value * factor) : rounder(value);
        }
      });
    this->Sink.rounding(rounder.account());
    rows.reportGone(this->Sink, info.channels);
  }

  /// Half of the normal in axes that look along -z, and a half.
  void addNormals(const Hdf5Eye& eye)
  {
    ClassedRows rows(this->Dataset, *eye.shot, "normal");
    const ImageInfo& info = rows.info();
    FloatRounder rounder(0.5F, "normal", "1");
    this->File.add("normals" + eye.suffix, Type::Float32, { info.height, info.width, 3 },
      [&](int, void* row)
      {
        rows.next();
        for (int i = 0; i < 3 * info.width; ++i)
        {
          const double sign = i % 3 == 0 ? 1 : -1;
          static_cast<float*>(row)[i] = rounder((sign * rows.at(i / 3, i % 3) + 1) / 2);
        }
      });
    this->Sink.rounding(rounder.account());
  }

  /// Half of the point in its object's frame, and a half; then 1 where there is one. Zeros for none.
  void addObjectCoordinates(const Hdf5Eye& eye)
  {
    ClassedRows rows(this->Dataset, *eye.shot, "objectcoords");
    const ImageInfo& info = rows.info();
    FloatRounder rounder(0, "objectcoords", "1");
    this->File.add("nocs" + eye.suffix, Type::Float32, { info.height, info.width, 4 },
      [&](int, void* row)
      {
        rows.next();
        for (int x = 0; x < info.width; ++x)
        {
          float* const pixel = static_cast<float*>(row) + 4 * std::size_t(x);
          for (int c = 0; c < 3; ++c)
          {
            pixel[c] = rounder((rows.at(x, c) + 1) / 2);
          }
          pixel[3] = std::isfinite(rows.at(x)) ? 1 : 0;
        }
      });
    this->Sink.rounding(rounder.account());
  }

  /// The ids that are seen.
  std::set<std::uint32_t> addIds(const Hdf5Eye& eye, const std::string& layer, const std::string& key)
  {
    const std::unique_ptr<RowReader> reader = this->Dataset.open(*eye.shot, layer);
    const ImageInfo& info = reader->info();
    std::set<std::uint32_t> seen;
    this->File.add(key + "_segmaps" + eye.suffix, Type::Int32, { info.height, info.width, 1 },
      [&](int y, void* row)
      {
        const Rows rows = reader->read(1);
        for (int x = 0; x < info.width; ++x)
        {
          const std::uint32_t id = idAt(rows, x, y);
          static_cast<std::int32_t*>(row)[x] = static_cast<std::int32_t>(id);
          seen.insert(id);
        }
      });
    this->Sink.rounding({ layer, "id", 0, std::uint64_t(info.width) * unsigned(info.height), 0 });
    return seen;
  }

  std::string attributes(const std::set<std::uint32_t>& seen) const
  {
    Json list = Json::array();
    for (const std::uint32_t id : seen)
    {
      const ObjectRecord* object = this->Dataset.object(id);
      list.push_back({ { "idx", id }, { "category_id", object ? object->classId : 0 },
        { "name", object ? utf8FromBytes(object->name) : "background" } });
    }
    return list.dump(-1, ' ', true);
  }

  std::string pose(const CameraRecord& camera) const
  {
    const auto list = [](const Eigen::Matrix3d& m) {
      return Json{ m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2) };
    };
    const Rigid3 view = cameraFromWorld(camera);
    const Eigen::Vector3d t = view.translation * this->Dataset.metres();
    return Json{
      { "cam_K", list(intrinsicsOf(camera, PixelCentre::Integer)) }, { "cam_R_w2c", list(view.rotation) },
      { "cam_t_w2c", { t.x(), t.y(), t.z() } }
    }.dump();
  }

  ExportSink& Sink;
  const DatasetView& Dataset;
  const OptionValues& Options;
  Hdf5File File;
};

class Hdf5Exporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), exported::depth().of(options), "objects", "classes" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireWhole(options, hdf5Name);
    requirePng(options, hdf5Name);
    requirePinholes(dataset, hdf5Name);
    dataset.metres();
    requireEverywhere(dataset, exported::color().of(options), hdf5Name, { "png" });
    for (const std::string& layer : { exported::depth().of(options), std::string("objects"), std::string("classes") })
    {
      requireEverywhere(dataset, layer, hdf5Name);
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "pixel_centre", "integer: cx and cy are 0.5 less" },
      { "axes", "camera_pose: x right, y down, z forward; normals: x right, y up, z back, (n + 1) / 2" },
      { "nothing", "depth, distance: 1e10; normals: 0.5; nocs: 0; flow, disparity: NaN" }, { "unit", "metres" },
      { "metres_per_unit", shortest(dataset.metres()) } };
    const std::vector<CameraEyes> cameras = eyesOfDisparities(dataset);
    for (const CameraEyes& eyes : cameras)
    {
      const std::string folder = cameras.size() == 1 ? "" : eyes.name + '/';
      plan.series.push_back(seriesOf(dataset, eyes.left,
        [&dataset, eyes, folder, options](const DatasetShot& left, std::size_t)
        { return item(dataset, left, eyes.right, folder, options); }));
    }
    return plan;
  }

private:
  static ExportItem item(const DatasetView& dataset, const DatasetShot& left, const std::string& right,
    const std::string& folder, const OptionValues& options)
  {
    std::vector<Hdf5Eye> eyes{ { &left, right.empty() ? "" : "_0" } };
    if (!right.empty())
    {
      eyes.push_back({ dataset.shot(right, left.frame()), "_1" });
    }
    const std::string name = folder + std::to_string(left.frame()) + ".hdf5";
    ExportItem item{ { name }, [&dataset, eyes, name, options](ExportSink& sink)
      {
        FrameFile file(sink, dataset, options);
        for (const Hdf5Eye& eye : eyes)
        {
          file.add(eye);
        }
        sink.write(name, file.bytes());
      } };
    for (const Hdf5Eye& eye : eyes)
    {
      item.names.push_back({ eye.shot->name(), eye.shot->frame(), name + eye.suffix });
    }
    return item;
  }
};
} // namespace

std::unique_ptr<Exporter> makeHdf5Exporter() { return std::make_unique<Hdf5Exporter>(); }

} // namespace dgtk
