// SPDX-License-Identifier: BSD-3-Clause
// A program with a camera model of its own, a file and a row: every layer either holds under it, as closed forms say,
// or is refused in a word before anything is written; the dataset tells of the camera.
#include <dgtkCameraEntry.h>
#include <dgtkDatasetDocuments.h>
#include <dgtkError.h>
#include <dgtkGenerator.h>
#include <dgtkRenderer.h>
#include <dgtkScene.h>
#include <dgtkVerification.h>

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

namespace
{
constexpr int width = 32;
constexpr int height = 24;
constexpr double wall = 4; ///< how far it is

void require(bool right, const std::string& what)
{
  if (!right)
  {
    std::fprintf(stderr, "%s\n", what.c_str());
    std::exit(1);
  }
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(b)); }

/// What a run is refused with, before anything is written; "" for one that is not.
std::string messageOf(const dgtk::GeneratorRequest& request)
{
  try
  {
    require(dgtk::generate(request).pictures == 2, "two pictures are rendered");
    return "";
  }
  catch (const dgtk::UsageError& error)
  {
    require(!std::filesystem::exists(request.folder), "nothing is written");
    return error.what();
  }
}

/// The layers that a run of them alone refuses by their names.
std::set<std::string> refused(dgtk::GeneratorRequest request, const std::string& folder)
{
  std::set<std::string> names;
  for (const dgtk::LayerInfo& info : dgtk::generatorLayers())
  {
    request.layers = { info.layer };
    request.folder = folder + "/" + info.layer;
    const std::string message = messageOf(request);
    if (!message.empty())
    {
      require(message.find(info.layer) != std::string::npos, message);
      names.insert(info.layer);
    }
  }
  return names;
}

class Pictures
{
public:
  explicit Pictures(const std::string& file)
  {
    require(this->Scene->Load(file), "the scene is loaded");
    this->Renderer->SetScene(this->Scene);
    this->Renderer->SetSize(width, height);
  }
  vtkSmartPointer<vtkDataArray> operator()(const char* layer)
  {
    vtkDataArray* const values = this->Renderer->Render(layer);
    require(values != nullptr && values->GetNumberOfTuples() == width * height, std::string(layer) + " is an array");
    return values;
  }

private:
  vtkNew<dgtkScene> Scene;
  vtkNew<dgtkRenderer> Renderer;
};

/// Of a wall across the axis before the camera, which is at the origin and looks along -z, and of one behind it.
int checkPixels(Pictures& pictures, const dgtk::CameraModel& camera)
{
  const auto objects = pictures("objects");
  const auto distance = pictures("distance");
  const auto depth = pictures("depth");
  const auto position = pictures("position");
  const auto normal = pictures("normal");
  const auto flow = pictures("flow_forward");
  int seen = 0; // behind
  for (int i = 0; i < width * height; ++i)
  {
    const Eigen::Vector2d centre(i % width + 0.5, i / width + 0.5);
    const Eigen::Vector3d direction = camera.rayThrough(centre).direction;
    const double side = direction.z() > 0 ? 1 : -1;
    const Eigen::Vector3d point = direction * (wall * side / direction.z());
    const bool hit = std::max(std::abs(point.x()), std::abs(point.y())) < 9;
    require(objects->GetComponent(i, 0) == (!hit ? 0 : side > 0 ? 1 : 2), "the walls are seen where they are");
    if (!hit)
    {
      require(std::isinf(distance->GetComponent(i, 0)), "there is nothing between them");
      continue;
    }
    seen += side < 0 ? 1 : 0;
    require(near(distance->GetComponent(i, 0), point.norm()), "its distance");
    require(near(depth->GetComponent(i, 0), side * wall), "its depth");
    require(near(normal->GetComponent(i, 2), -side), "its normal");
    const Eigen::Vector3d world(
      position->GetComponent(i, 0), position->GetComponent(i, 1), position->GetComponent(i, 2));
    Eigen::Vector2d pixel;
    require(camera.project({ world.x(), -world.y(), -world.z() }, pixel) && (pixel - centre).norm() < 1e-9,
      "its position is projected to the pixel's centre");
    require(camera.project(point + Eigen::Vector3d(side > 0 ? 0.25 : 0, 0, 0), pixel), "its next place is projected");
    require(
      near(flow->GetComponent(i, 0), pixel.x() - centre.x()) && near(flow->GetComponent(i, 1), pixel.y() - centre.y()),
      "its flow");
  }
  return seen;
}
} // namespace

int main(int, char** argv)
{
  dgtk::GeneratorRequest request;
  request.scene = argv[1];
  request.width = width;
  request.height = height;
  request.replace = true;
  request.options = { { "matte", "wall" } };
  const std::string folder = argv[2];
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  // What is said by matrices, and what needs another camera or a lens that blurs.
  const std::set<std::string> wanted{ "calibration", "color_sharp", "correspondence", "disparity", "disparity_forward",
    "disparity_backward", "pov" };
  require(refused(request, folder) == wanted, "these layers are refused, and all others hold");
  std::set<std::string> drawn{ "color", "color_noisy", "color_rgba", "ldi", "matting", "tiles" };
  drawn.insert(wanted.begin(), wanted.end());
  request.options["renderer"] = "vtk";
  require(refused(request, folder + "/drawn") == drawn, "OpenGL does not draw it");
  request.layers = { "depth" };
  request.folder = folder + "/dgd";
  request.options = { { "depth_format", "npy,dgd" } };
  require(
    messageOf(request) == "layer depth as dgd: camera 'wide' (equidistant) has no linear projection", "so is .dgd");

  request.layers.clear();
  request.options = { { "matte", "wall" } };
  for (const dgtk::LayerInfo& info : dgtk::generatorLayers())
  {
    if (wanted.count(info.layer) == 0)
    {
      request.layers.push_back(info.layer);
    }
  }
  request.folder = folder + "/all";
  dgtk::generate(request);
  const dgtk::VerificationReport report = dgtk::verifyDataset(request.folder, 2);
  require(report.passed(), dgtk::verificationText(report));

  const dgtk::CameraRecord record = dgtk::readCameras(request.folder + "/cameras.json").at(0);
  require(record.model == "equidistant" && !record.hasK && record.numbers.size() == 1 &&
            record.numbers.at("halfAngle") == std::vector<double>{ 80 },
    "the dataset tells of the camera");
  const auto camera = dgtk::makeCamera(record.model, { record.width, record.height, {}, record.numbers, record.files });
  Pictures pictures(request.scene);
  require(checkPixels(pictures, *camera) > 20, "the wall behind is seen");
  return 0;
}
