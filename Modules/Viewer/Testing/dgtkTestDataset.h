// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTestDataset_h
#define dgtkTestDataset_h

#include "dgtkDatasetDocuments.h"
#include "dgtkFile.h"
#include "dgtkLayerWriter.h"
#include "dgtkPixelValues.h"
#include "dgtkTestSupport.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <functional>
#include <string>

namespace dgtk::test
{

/// A dataset on disk whose numbers a test chooses: cameras "left" (pinhole with skew, turned) and "right"
/// (orthographic), frames 0 and 1, three objects.
class SmallDataset
{
public:
  static constexpr int width = 12;
  static constexpr int height = 7;

  SmallDataset()
  {
    this->Parts.units = "metre";
    this->Parts.version = "test";
    makeFolders(this->path());
    for (const int frame : { 0, 1 })
    {
      this->Cameras.push_back(left(frame));
      this->Cameras.push_back(right(frame));
    }
    this->Objects = { { 1, "floor", "ground", 1, "", 2 }, { 2, "mill", "building", 2, "", 5 },
      { 3, "tree", "plant", 3, "", 9 } };
  }

  static CameraRecord left(int frame)
  {
    CameraRecord camera;
    camera.name = "left";
    camera.frame = frame;
    camera.width = width;
    camera.height = height;
    camera.K << 11, 0.25, 5.5, 0, 12, 3.75, 0, 0, 1;
    camera.R = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
    camera.t = Eigen::Vector3d(0.5 + frame, -2, 4);
    camera.near = 0.1;
    camera.far = 100;
    return camera;
  }
  static CameraRecord right(int frame)
  {
    CameraRecord camera = left(frame);
    camera.name = "right";
    camera.model = "orthographic";
    camera.K << 4, 0, width / 2.0, 0, 4, height / 2.0, 0, 0, 1;
    return camera;
  }

  std::string path(const std::string& name = {}) const
  {
    return this->Folder.path(name.empty() ? "set" : "set/" + name);
  }

  /// Writes <camera>/<folder>/<frame><suffix>.<format>; `value` of column, row and channel.
  void add(const std::string& camera, const std::string& folder, int frame, const std::string& suffix,
    const std::string& format, const LayerSpec& spec, const std::function<double(int, int, int)>& value)
  {
    Rows rows(spec.type, spec.channels, width, 0, height);
    for (int y = 0; y < height; ++y)
    {
      for (int i = 0; i < width * spec.channels; ++i)
      {
        put(rows, y, i, value(i / spec.channels, y, i % spec.channels));
      }
    }
    const std::string name = this->place(camera, folder, frame, suffix, format);
    const auto writer = makeLayerWriter(format, this->path(name), spec, width, height);
    writer->write(rows);
    const FileRecord record = writer->finish();
    this->list({ name, record.bytes, record.sha256, spec.name, camera, frame }, spec, format);
  }

  /// The name of a file whose folder is there then.
  std::string place(const std::string& camera, const std::string& folder, int frame, const std::string& suffix,
    const std::string& extension) const
  {
    std::filesystem::create_directories(this->path(camera + "/" + folder));
    return camera + "/" + folder + "/00000" + std::to_string(frame) + suffix + "." + extension;
  }
  void list(const DatasetFile& file, const LayerSpec& spec, const std::string& format)
  {
    this->Parts.files.push_back(file);
    this->Parts.files.back().sha256 = std::string(64, '0');
    bool known = false;
    for (const LayerRecord& record : this->Parts.layers)
    {
      known = known || (record.spec.name == spec.name && record.format == format);
    }
    if (!known)
    {
      this->Parts.layers.push_back({ spec, format });
    }
  }
  /// Writes the documents.
  void finish() const
  {
    writeDocument(this->path(), "cameras.json", camerasText(this->Cameras));
    writeDocument(this->path(), "objects.json", objectsText(this->Objects));
    writeDocument(this->path(), "manifest.json", manifestText(this->Parts));
  }

  std::vector<ObjectRecord> Objects;
  std::vector<CameraRecord> Cameras;
  Manifest Parts;

private:
  static void put(Rows& rows, int y, int i, double value)
  {
    withPixelType(rows.type(), [&](auto type) { rows.row<decltype(type)>(y)[i] = static_cast<decltype(type)>(value); });
  }

  TemporaryFolder Folder;
};

} // namespace dgtk::test

#endif
