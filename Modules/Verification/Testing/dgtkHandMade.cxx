// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHandMade.h"

#include "dgtkFile.h"
#include "dgtkMeter.h"
#include "dgtkVerification.h"

#include <filesystem>

namespace dgtk::test
{

namespace
{
template <typename Number>
void append(std::string& bytes, double value)
{
  const auto number = static_cast<Number>(value);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}
} // namespace

HandMade::HandMade(
  const std::vector<std::string>& models, const std::vector<std::string>& more, const std::vector<std::string>& cameras)
{
  std::string objects;
  for (std::size_t i = 0; i < models.size(); ++i)
  {
    const std::string name = 'o' + std::to_string(i + 1);
    writeFile(this->Folder.path(name + ".obj"), models[i]);
    objects += std::string(i > 0 ? "," : "") + R"({"name": ")" + name + R"(", "model": ")" + name + R"(.obj")" +
               (i < more.size() ? more[i] : "") + '}';
    ObjectRecord& record = this->Objects.emplace_back();
    record.id = std::uint32_t(i + 1);
    record.name = name;
    record.classId = 1;
  }
  std::string views;
  for (const std::string& name : cameras)
  {
    views += std::string(views.empty() ? "" : ",") + R"({"name": ")" + name +
             R"(", "width": 8, "height": 6, "eye": [0, 0, 0], "lookAt": [0, 0, 1], "near": 0.1, "far": 100})";
    CameraRecord record;
    record.name = name;
    record.width = width;
    record.height = height;
    record.K << 100, 0, 4.5, 0, 100, 2.5, 0, 0, 1;
    record.near = 0.1;
    record.far = 100;
    this->Cameras.push_back(record);
  }
  this->file("scene.json", R"({"objects": [)" + objects + R"(], "cameras": [)" + views + "]}");
  this->file("objects.json", objectsText(this->Objects));
}

CameraRecord& HandMade::later()
{
  CameraRecord record = this->Cameras.front();
  record.frame = 1;
  this->Cameras.push_back(record);
  return this->Cameras.back();
}

void HandMade::image(
  const std::string& name, int channels, const std::function<double(int x, int y, int channel)>& value, bool narrow)
{
  std::string header = std::string("{'descr': '") + (narrow ? "<f4" : "<f8") + "', 'fortran_order': False, 'shape': (" +
                       std::to_string(height) + ", " + std::to_string(width) +
                       (channels > 1 ? ", " + std::to_string(channels) : "") + "), }";
  header.append(117 - header.size(), ' ');
  std::string bytes = std::string("\x93NUMPY\x01", 7) + std::string("\0v\0", 3) + header + '\n';
  for (int y = 0; y < height; ++y)
  {
    for (int i = 0; i < width * channels; ++i)
    {
      const double number = value(i / channels, y, i % channels);
      narrow ? append<float>(bytes, number) : append<double>(bytes, number);
    }
  }
  this->file(name, bytes);
}

void HandMade::file(const std::string& name, const std::string& text)
{
  const std::string path = this->Folder.path(name);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  writeFile(path, text);
  DatasetFile file;
  file.path = name;
  this->TheManifest.files.push_back(file);
}

std::unique_ptr<Dataset> HandMade::dataset()
{
  for (DatasetFile& file : this->TheManifest.files)
  {
    file.sha256 = std::string(64, '0');
  }
  writeFile(this->Folder.path("cameras.json"), camerasText(this->Cameras));
  writeFile(this->Folder.path("objects.json"), objectsText(this->Objects));
  writeFile(this->Folder.path("manifest.json"), manifestText(this->TheManifest));
  auto dataset = std::make_unique<Dataset>(this->Folder.path(), 1);
  for (const Dataset::Problem& problem : dataset->problems())
  {
    throw std::runtime_error(problem.file + ": " + problem.what);
  }
  return dataset;
}

Residual HandMade::verify(const std::string& check, const std::string& layer)
{
  this->dataset();
  for (const Residual& residual : verifyDataset(this->Folder.path(), 1, { check }).residuals)
  {
    if (residual.layer == layer)
    {
      return residual;
    }
    if (residual.check != check || residual.largest == infinite)
    {
      throw std::runtime_error(describe(residual));
    }
  }
  return {};
}

std::string triangleModel(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const std::string& face)
{
  std::string text;
  for (const Eigen::Vector3d& x : { a, b, c })
  {
    text += "v " + numberText(x.x()) + ' ' + numberText(x.y()) + ' ' + numberText(x.z()) + '\n';
  }
  return text + face + '\n';
}

std::string wallModel(double depth)
{
  return triangleModel(
    { -90 * depth, -90 * depth, depth }, { 90 * depth, -90 * depth, depth }, { 0, 90 * depth, depth });
}

} // namespace dgtk::test
