// SPDX-License-Identifier: BSD-3-Clause
// The engines against one another and against bare Embree, on every sample model and scene.
#include "dgtkMattingSource.h"
#include "dgtkRasterSource.h"
#include "dgtkRayPictures.h"
#include "dgtkRaySource.h"
#include "dgtkStage.h"
#include "dgtkSurfaceRows.h"
#include "dgtkSyntheticScene.h"
#include "dgtkTestSupport.h"
#include "dgtkThreadPool.h"

#include "dgtkError.h"
#include "dgtkModelReader.h"

#include <Eigen/LU>

#include <embree3/rtcore.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

constexpr double nearEdge = 1.0 / 128; // pixels
/// Relative difference of depth below which the raster engine's float depth cannot tell surfaces apart.
constexpr double coincident = 1e-6;
/// The same of rays in single precision.
constexpr double singlePrecision = 1e-5;
constexpr int width = 320;
constexpr int height = 240;

struct Case
{
  std::string name;
  std::shared_ptr<const SceneState> state;
  View view;
};

std::vector<std::string> filesBelow(const std::string& folder, const std::vector<std::string>& extensions)
{
  std::vector<std::string> files;
  if (!folder.empty() && std::filesystem::exists(folder))
  {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
      const std::string extension = entry.path().extension().string();
      if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
      {
        files.push_back(entry.path().string());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// A model alone, seen as a whole from a corner; nothing for files without surfaces and, among the samples, damaged
/// ones.
bool caseOfModel(const std::string& path, bool damaged, Case& result)
{
  std::shared_ptr<const Model> model;
  try
  {
    model = readModel(path);
  }
  catch (const Error& error)
  {
    EXPECT_TRUE(damaged) << error.what();
    return false; // the readers' tests are about them
  }
  if (model->triangles.empty())
  {
    return false;
  }
  auto state = std::make_shared<SceneState>();
  Instance instance;
  instance.model = model;
  instance.geometry = model->rest;
  instance.materials = std::make_shared<std::vector<Material>>(model->materials);
  state->instances.push_back(instance);
  state->lights.emplace_back();
  state->lights.back().kind = LightKind::Head;
  const Eigen::Vector3d centre = (model->boundsMin + model->boundsMax) / 2;
  const double size = std::max((model->boundsMax - model->boundsMin).maxCoeff(), 1e-6);
  result.name = std::filesystem::path(path).filename().string();
  result.view.model = makePinholeFromFov(width, height, 40, 0);
  result.view.camera_from_world = lookAtPose(centre + size * Eigen::Vector3d(1.1, 0.9, 1.3), centre, { 0, 1, 0 });
  result.view.near = 0.01 * size;
  result.view.far = 100 * size;
  result.state = state;
  return true;
}

/// The samples that other parsers found triangles in.
std::set<std::string> readableSamples()
{
  std::set<std::string> names;
  if (!extraModels().empty())
  {
    std::ifstream file(extraModels() + "/TRUTH.json");
    const nlohmann::json samples = nlohmann::json::parse(file); // outlives the loop over its items
    for (const auto& [name, truth] : samples.items())
    {
      if (truth.is_object() && truth.value("triangles", 0) > 0)
      {
        names.insert(extraModels() + '/' + name);
      }
    }
  }
  return names;
}

const std::vector<Case>& sampleModels()
{
  static std::vector<Case> cases; // read once
  if (!cases.empty())
  {
    return cases;
  }
  const std::set<std::string> readable = readableSamples();
  const std::vector<std::string> extensions = { ".ac", ".acc", ".md2", ".3ds", ".pov", ".obj", ".gltf", ".glb", ".ply",
    ".stl", ".off", ".dae" };
  for (const std::string& folder : { sourceFile("Data/Models"), extraModels() })
  {
    for (const std::string& path : filesBelow(folder, extensions))
    {
      Case found;
      if (caseOfModel(path, folder == extraModels() && readable.count(path) == 0, found))
      {
        cases.push_back(found);
      }
    }
  }
  return cases;
}

/// First and middle frame of each scene, every camera that OpenGL can draw (three at most).
const std::vector<Case>& sampleScenes()
{
  static std::vector<Case> cases; // read once
  if (!cases.empty())
  {
    return cases;
  }
  for (const std::string& path : filesBelow(sourceFile("Data/Scenes"), { ".json", ".scene" }))
  {
    const auto stage = Stage::load(readScene(path));
    const int first = stage->description().firstFrame();
    const int middle = (first + stage->description().lastFrame()) / 2;
    const std::size_t cameras = std::min<std::size_t>(3, stage->cameraNames().size());
    for (std::size_t camera = 0; camera < cameras; ++camera)
    {
      const int frame = camera == 0 ? first : middle;
      const View view = stage->view(camera, frame, width, height);
      if (view.model->linear() && !view.instants)
      {
        cases.push_back({ std::filesystem::path(path).filename().string() + '/' + view.name, stage->at(frame), view });
      }
    }
  }
  return cases;
}

/// Pixels in which the engines see different triangles, all at the same place.
struct Counts
{
  std::size_t pixels = 0;
  std::size_t coinciding = 0;
  std::size_t otherObjects = 0; ///< of the coinciding ones
  void operator+=(const Counts& other)
  {
    this->pixels += other.pixels;
    this->coinciding += other.coinciding;
    this->otherObjects += other.otherObjects;
  }
};

double depthAt(const Case& c, const Hit& hit, const Eigen::Vector2d& pixel)
{
  return hit.object == 0 ? INFINITY : surfacePointAt(*c.state, c.view, pixel, hit).t;
}

bool isCutOutAt(const Case& c, const Hit& hit, const Eigen::Vector2d& pixel)
{
  const SurfacePoint point = surfacePointAt(*c.state, c.view, pixel, hit);
  return isCutOut(c.state->instances[hit.object - 1], hit.triangle, point.barycentrics);
}

/// Whether a cut-out is there at some points within 1/128 pixel and not at others.
bool isOnTexelBorder(const Case& c, const Hit& hit, const Eigen::Vector2d& pixel)
{
  if (hit.object == 0)
  {
    return false;
  }
  int gone = 0;
  for (int i = 0; i < 9; ++i)
  {
    const Eigen::Vector2d offset(i % 3 - 1, i / 3 - 1);
    gone += isCutOutAt(c, hit, pixel + nearEdge * offset);
  }
  return gone > 0 && gone < 9;
}

/// Why two engines may see other surfaces at a point of the image.
enum class Reason
{
  None,
  Edge,
  Coincident,
  Texel,
};

Reason reasonOf(const Case& c, const Hit (&hits)[2], const Eigen::Vector2d& pixel, double sameDepth)
{
  const double depths[2] = { depthAt(c, hits[0], pixel), depthAt(c, hits[1], pixel) };
  for (const Hit& hit : hits)
  {
    if (hit.object != 0 && edgeDistance(*c.state, c.view, hit, pixel) <= nearEdge)
    {
      return Reason::Edge;
    }
  }
  if (std::abs(depths[0] - depths[1]) <= sameDepth * std::min(depths[0], depths[1]))
  {
    return Reason::Coincident;
  }
  return isOnTexelBorder(c, hits[0], pixel) || isOnTexelBorder(c, hits[1], pixel) ? Reason::Texel : Reason::None;
}

Counts compareEngines(const Case& c, VisibilitySource& raster, VisibilitySource& ray)
{
  VisibilityBuffer one, two;
  raster.setScene(c.state, c.view);
  raster.render({ 0, 0, width, height }, one);
  ray.setScene(c.state, c.view);
  ray.render({ 0, 0, width, height }, two);
  Counts counts;
  counts.pixels = one.hits.size();
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const Hit hits[2] = { one.at(x, y), two.at(x, y) };
      if (hits[0] == hits[1])
      {
        continue;
      }
      const Eigen::Vector2d centre(x + 0.5, y + 0.5);
      const double depths[2] = { depthAt(c, hits[0], centre), depthAt(c, hits[1], centre) };
      if (std::abs(depths[0] - depths[1]) <= coincident * std::min(depths[0], depths[1]))
      {
        ++counts.coinciding;
        counts.otherObjects += hits[0].object != hits[1].object ? 1 : 0;
        continue;
      }
      ADD_FAILURE() << c.name << " at " << x << ", " << y << ": raster " << hits[0].object << ':' << hits[0].triangle
                    << " at " << depths[0] << ", ray " << hits[1].object << ':' << hits[1].triangle << " at "
                    << depths[1];
    }
  }
  return counts;
}

/// Edges and borders of missing texels are settled exactly; what may differ are surfaces that lie on one another.
void compareAll(const std::vector<Case>& cases, std::size_t mostCoinciding, std::size_t mostOtherObjects)
{
  ThreadPool pool(2);
  const auto raster = makeRasterSource();
  const auto ray = makeRaySource(pool);
  Counts all;
  for (const Case& c : cases)
  {
    all += compareEngines(c, *raster, *ray);
  }
  std::printf("%zu cases, %zu pixels: %zu differ, all on coincident surfaces, %zu of them of another object\n",
    cases.size(), all.pixels, all.coinciding, all.otherObjects);
  EXPECT_GT(cases.size(), 5U);
  EXPECT_LE(all.coinciding, mostCoinciding);
  EXPECT_LE(all.otherObjects, mostOtherObjects);
}

/// Embree without anything of ours: float triangles relative to the camera, in its frame.
class BareEmbree
{
public:
  explicit BareEmbree(const Case& c)
    : Device(rtcNewDevice(nullptr))
    , Scene(rtcNewScene(this->Device))
  {
    for (const Instance& instance : c.state->instances)
    {
      RTCGeometry mesh = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_TRIANGLE);
      const auto& points = instance.geometry->positions;
      const auto& triangles = instance.model->triangles;
      auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
        3 * sizeof(float), std::max<std::size_t>(1, points.size())));
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        Eigen::Map<Eigen::Vector3f> target(vertices + 3 * i);
        target = (c.view.camera_from_world * (instance.world_from_object * points[i])).cast<float>();
      }
      auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0,
        RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), std::max<std::size_t>(1, triangles.size())));
      for (std::size_t i = 0; i < triangles.size(); ++i)
      {
        std::copy(triangles[i].begin(), triangles[i].end(), indices + 3 * i);
      }
      rtcCommitGeometry(mesh);
      rtcAttachGeometry(this->Scene, mesh);
      rtcReleaseGeometry(mesh);
    }
    rtcSetSceneFlags(this->Scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(this->Scene);
  }
  ~BareEmbree()
  {
    rtcReleaseScene(this->Scene);
    rtcReleaseDevice(this->Device);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  /// Depth along the ray through an image point; the triangle goes to `hit`.
  double depth(const View& view, const Eigen::Vector2d& pixel, Hit& hit) const
  {
    const CameraRay ray = view.model->rayThrough(pixel);
    RTCRayHit query = {};
    query.ray.org_x = float(ray.origin.x());
    query.ray.org_y = float(ray.origin.y());
    query.ray.org_z = float(ray.origin.z());
    query.ray.dir_x = float(ray.direction.x());
    query.ray.dir_y = float(ray.direction.y());
    query.ray.dir_z = float(ray.direction.z());
    query.ray.tnear = float(view.near);
    query.ray.tfar = float(view.far);
    query.ray.mask = 0xFFFFFFFFu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(this->Scene, &context, &query);
    hit = query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? Hit{} : Hit{ query.hit.geomID + 1, query.hit.primID };
    return double(query.ray.tfar);
  }

private:
  RTCDevice Device;
  RTCScene Scene;
};
} // namespace

namespace
{
/// Pictures by OpenGL and by rays of the same scenes, without shadows: what differs is seen at edges, and where
/// textures are made smaller.
void comparePictures(const std::vector<Case>& cases)
{
  ThreadPool pool(2);
  const auto drawn = makeRasterSource();
  const auto shaded = makeRayPictures(pool);
  for (const Case& c : cases)
  {
    const auto state = std::make_shared<SceneState>(*c.state);
    for (LightState& light : state->lights)
    {
      light.shadows = false;
    }
    const PixelRect whole{ 0, 0, width, height };
    ColorBuffer colors[2];
    int source = 0;
    for (PictureSource* pictures : { static_cast<PictureSource*>(drawn.get()), shaded.get() })
    {
      pictures->setScene(state, c.view);
      pictures->renderColor(whole, 1, colors[source++], nullptr);
    }
    double sum = 0;
    int far = 0;
    for (std::size_t i = 0; i < colors[0].rgb.size(); ++i)
    {
      const double difference = 255 * std::abs(double(colors[0].rgb[i]) - std::min(1.0, double(colors[1].rgb[i])));
      sum += difference;
      far += difference > 16;
    }
    EXPECT_LT(sum / double(colors[0].rgb.size()), 1.0) << c.name;
    EXPECT_LT(far, 0.002 * double(colors[0].rgb.size())) << c.name;
  }
}
} // namespace

TEST(Engines, PicturesByRasterAndRayAgreeOnEverySampleModel) { comparePictures(sampleModels()); }

TEST(Engines, PicturesByRasterAndRayAgreeOnEveryScene) { comparePictures(sampleScenes()); }

/// A picture of several tiles goes on with the whole scene, whatever mattes took out of it.
TEST(Engines, MattesLeaveTheSceneAsItWas)
{
  ThreadPool pool(2);
  ViewOptions options;
  options.width = 24;
  options.height = 16;
  const View view = makeView(options);
  const auto state =
    SceneBuilder().add(makeSphere({ { 0, 0, 0 }, 1.1, 12, 20 })).add(makeBox(), placement({ 0.8, 0, 1 })).state();
  const PixelRect whole{ 0, 0, options.width, options.height };
  const auto drawn = makeRasterSource();
  drawn->setHits(true);
  const auto shaded = makeRayPictures(pool);
  for (PictureSource* pictures : { static_cast<PictureSource*>(drawn.get()), shaded.get() })
  {
    ColorBuffer colors[2];
    VisibilityBuffer hits[2];
    pictures->setScene(state, view);
    pictures->renderColor(whole, 1, colors[0], nullptr);
    pictures->render(whole, hits[0]);
    MattingSource mattes(*pictures, { 1, 2 }, 2);
    mattes.setScene(state, view);
    EXPECT_EQ(mattes.draw(whole).size(), 2u);
    pictures->renderColor(whole, 1, colors[1], nullptr);
    pictures->render(whole, hits[1]);
    EXPECT_EQ(colors[0].rgb, colors[1].rgb);
    EXPECT_EQ(hits[0].hits, hits[1].hits);
    EXPECT_TRUE(std::any_of(hits[0].hits.begin(), hits[0].hits.end(), [](const Hit& hit) { return hit.object == 2; }));
  }
}

TEST(Engines, RasterAndRayAgreeOnEverySampleModel) { compareAll(sampleModels(), 1, 0); }

TEST(Engines, RasterAndRayAgreeOnEveryScene) { compareAll(sampleScenes(), 0, 0); }

TEST(Engines, DepthIsThatOfBareEmbree)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  double largest = 0;
  std::size_t compared = 0, other = 0;
  for (const Case& c : sampleModels())
  {
    VisibilityBuffer buffer;
    source->setScene(c.state, c.view);
    source->render({ 0, 0, width, height }, buffer);
    SurfaceRows rows;
    computeSurfaceRows(*c.state, c.view, buffer.rect, buffer.hits.data(), false, rows);
    const BareEmbree embree(c);
    for (std::size_t i = 0; i < rows.t.size(); ++i)
    {
      Hit hit;
      const double depth = embree.depth(c.view, { double(i % width) + 0.5, double(i / width) + 0.5 }, hit);
      if (hit != buffer.hits[i])
      {
        const Eigen::Vector2d centre(double(i % width) + 0.5, double(i / width) + 0.5);
        const bool gone = hit.object != 0 && isCutOutAt(c, hit, centre); // which bare Embree does not know
        EXPECT_TRUE(gone || reasonOf(c, { hit, buffer.hits[i] }, centre, singlePrecision) != Reason::None)
          << c.name << " at " << centre.transpose() << ": bare " << hit.object << ':' << hit.triangle << " at " << depth
          << ", exact " << buffer.hits[i].object << ':' << buffer.hits[i].triangle << " at " << rows.t[i];
        ++other;
        continue;
      }
      if (hit.object == 0)
      {
        continue;
      }
      ++compared;
      const double error = std::abs(depth - rows.t[i]) / rows.t[i];
      largest = std::max(largest, error);
      EXPECT_LT(error, 1e-5) << c.name << " at " << i % width << ", " << i / width;
    }
  }
  std::printf("%zu depths compared, largest relative difference %.2g; %zu pixels see another triangle\n", compared,
    largest, other);
  EXPECT_GT(compared, 20000U);
}
