// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLiveTruth.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkGenerator.h"
#include "dgtkLayerReader.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <thread>

namespace
{
using namespace dgtk;
using test::sourceFile;

constexpr int truthWidth = 96;
constexpr int truthHeight = 72;

LiveQuestion questionOf(const std::string& file, std::size_t camera, int frame, int w = truthWidth, int h = truthHeight)
{
  const SceneDescription scene = readScene(sourceFile(file));
  ModelLibrary models;
  models.load(scene);
  LiveQuestion question;
  question.scene = std::make_shared<LiveScene>(scene, models);
  question.frame = frame;
  question.camera = scene.cameras[camera];
  question.width = w;
  question.height = h;
  return question;
}

/// All layers of all cameras at frame 1, each in the format that keeps its values.
void render(const std::string& file, const std::string& folder)
{
  GeneratorRequest request;
  request.scene = sourceFile(file);
  request.folder = folder;
  request.layers = { "all" };
  for (const LayerInfo& info : generatorLayers())
  {
    if (info.formats.size() > 1 && std::find(info.formats.begin(), info.formats.end(), "npy") != info.formats.end())
    {
      request.options[info.layer + "_format"] = "npy";
    }
  }
  request.frames = FrameRange{ 1, 1, 1 };
  request.width = truthWidth;
  request.height = truthHeight;
  request.options["samples"] = "4";
  request.options["threads"] = "1";
  generate(request);
}

/// The files of the first camera, by the names of their images; several of one name are those of several cameras.
std::multimap<std::string, std::string> filesOf(const std::string& folder, const std::string& camera)
{
  std::multimap<std::string, std::string> files;
  for (const DatasetFile& file : readManifestIn(folder).files)
  {
    if (file.camera == camera)
    {
      files.emplace(file.layer, folder + '/' + file.path);
    }
  }
  return files;
}

/// Every layer of the registry is seen live as in its file, or refused in words.
TEST(LiveTruth, EveryLayerIsTheDatasetBitForBit)
{
  const char* const scene = "Data/Scenes/demo.json";
  const test::TemporaryFolder folder;
  render(scene, folder.path("out"));
  const LiveQuestion question = questionOf(scene, 0, 1);
  const auto files = filesOf(folder.path("out"), question.camera.name);
  ThreadPool pool(1);
  LiveEye eye(question, 1, pool);
  VisibilityBuffer hits;
  ASSERT_TRUE(eye.trace(0, truthHeight, hits));
  std::set<std::string> shown;
  for (const LiveLayer& layer : liveLayers())
  {
    EXPECT_TRUE(shown.insert(layer.name).second) << layer.name;
    if (layer.name == draftLayer)
    {
      continue;
    }
    EXPECT_EQ(eye.missing(layer.name), "") << layer.name;
    ASSERT_EQ(files.count(layer.name), 1u) << layer.name;
    const ImageData stored = readLayerFile(files.find(layer.name)->second);
    const Rows live = eye.values(layer.name, hits);
    ASSERT_EQ(live.type(), stored.pixels.type()) << layer.name;
    ASSERT_EQ(live.bytes(), stored.pixels.bytes()) << layer.name;
    EXPECT_EQ(std::memcmp(live.data(), stored.pixels.data(), live.bytes()), 0) << layer.name;
  }
  int refused = 0;
  for (const LayerInfo& info : generatorLayers())
  {
    refused += liveRefusal(info).empty() ? 0 : 1;
    for (const LayerRecord& record : info.records)
    {
      EXPECT_EQ(shown.count(record.spec.name) == 1, liveRefusal(info).empty()) << record.spec.name;
    }
  }
  EXPECT_EQ(refused, 14) << "a new layer is seen live, or this number says that it is not";
  EXPECT_THROW(eye.values("color", hits), UsageError);
}

/// The demo through lenses: what ends within the image, and what has no end.
std::string writeLenses(const test::TemporaryFolder& folder)
{
  SceneDescription scene = readScene(sourceFile("Data/Scenes/demo.json"));
  scene.cameras.resize(1);
  scene.cameras.push_back(scene.cameras[0]);
  CameraDescription& fisheye = scene.cameras[0];
  fisheye.model = "fisheye";
  fisheye.fovY = Track<double>{ 179 };
  fisheye.aspect = 0.75; // narrower pixels, so that the circle ends within
  fisheye.parameters["distortion"].numbers.assign(4, Track<double>{ -0.05 });
  CameraDescription& panorama = scene.cameras[1];
  panorama.name = "panorama";
  panorama.model = "equirectangular";
  panorama.fovY = CameraDescription().fovY;
  fisheye.rollingShutter = { 0.7, RollingShutter::Direction::Left };
  fisheye.eye.keys = { { 0, { 0.5, 2, 9 } }, { 4, { -0.5, 2.5, 8 } } };
  fisheye.lookAt.keys.clear();
  scene.cameras.push_back(scene.cameras[1]);
  scene.cameras[2].name = "rolling";
  scene.cameras[2].rollingShutter = { 0.4, RollingShutter::Direction::Down };
  writeScene(scene, folder.path("lenses.json"));
  return folder.path("lenses.json");
}

TEST(LiveTruth, LensesAreTheDatasetBitForBit)
{
  const test::TemporaryFolder folder;
  GeneratorRequest request;
  request.scene = writeLenses(folder);
  request.folder = folder.path("out");
  request.layers = { "color", "depth", "distance", "objects", "triangles", "normal", "shadingnormal", "position", "uv",
    "flow_forward", "edges" };
  request.options = { { "objects_format", "npy" }, { "triangles_format", "npy" }, { "flow_forward_format", "npy" },
    { "edges_format", "npy" }, { "threads", "1" }, { "visibility", "ray" } };
  request.frames = FrameRange{ 1, 1, 1 };
  request.width = truthWidth;
  request.height = truthHeight;
  generate(request);
  ThreadPool pool(1);
  const SceneDescription scene = readScene(request.scene);
  ModelLibrary models;
  models.load(scene);
  LiveQuestion question;
  question.scene = std::make_shared<LiveScene>(scene, models);
  question.frame = 1;
  question.width = truthWidth;
  question.height = truthHeight;
  for (const CameraDescription& camera : scene.cameras)
  {
    question.camera = camera;
    LiveEye eye(question, 1, pool);
    VisibilityBuffer hits;
    ASSERT_TRUE(eye.trace(0, truthHeight, hits));
    std::size_t compared = 0;
    for (const auto& [layer, file] : filesOf(request.folder, question.camera.name))
    {
      const ImageData stored = readLayerFile(file);
      const Rows live = eye.values(layer == "color" ? draftLayer : layer, hits);
      ASSERT_EQ(live.bytes(), stored.pixels.bytes()) << layer;
      EXPECT_EQ(std::memcmp(live.data(), stored.pixels.data(), live.bytes()), 0) << layer;
      ++compared;
    }
    EXPECT_GE(compared, request.layers.size());
    EXPECT_EQ(hits.hits[0].object, 0u) << "around the circle, or the sky";
  }
}

TEST(LiveTruth, APixelIsThePictures)
{
  const LiveQuestion question = questionOf("Data/Scenes/dataset_flow.json", 0, 1);
  ThreadPool pool(1);
  LiveEye eye(question, 1, pool);
  VisibilityBuffer hits;
  eye.trace(0, truthHeight, hits);
  const Rows depth = eye.values("depth", hits);
  const Rows flow = eye.values("flow_forward", hits);
  const Rows edges = eye.values("edges", hits);
  int surfaces = 0;
  for (int row = 5; row < truthHeight; row += 16)
  {
    for (int column = 3; column < truthWidth; column += 16)
    {
      const PixelTruth truth = pixelTruth(question, column, row, pool);
      const auto value = [&](const char* layer)
      {
        for (const PixelValue& one : truth.values)
        {
          if (one.spec.name == layer)
          {
            return one.values;
          }
        }
        return std::vector<double>();
      };
      const Hit& hit = hits.at(column, row);
      EXPECT_EQ(value("objects").at(0), hit.object);
      EXPECT_EQ(value("depth").at(0), depth.row<double>(row)[column]);
      EXPECT_EQ(truth.object.empty(), hit.object == 0);
      EXPECT_EQ(truth.id, hit.object);
      ASSERT_EQ(truth.layers.empty(), hit.object == 0);
      if (hit.object != 0)
      {
        ++surfaces;
        EXPECT_EQ(value("flow_forward").at(0), flow.row<double>(row)[2 * column]);
        EXPECT_EQ(truth.layers.front().depth, value("depth").at(0));
        EXPECT_EQ(truth.layers.front().triangle, value("triangles").at(0));
        EXPECT_EQ(truth.triangle, value("triangles").at(0));
        EXPECT_EQ(truth.partId, value("parts").at(0));
        EXPECT_EQ(value("edges").at(0), edges.row<std::uint8_t>(row)[column]) << "of three rows only";
        EXPECT_EQ(truth.layers.front().object, truth.object);
        for (std::size_t i = 1; i < truth.layers.size(); ++i)
        {
          EXPECT_LE(truth.layers[i - 1].depth, truth.layers[i].depth);
        }
      }
    }
  }
  EXPECT_GT(surfaces, 10);
  EXPECT_THROW(pixelTruth(question, truthWidth, 0, pool), std::exception);
}

/// Each other camera has its correspondence by its name; surfaces are at depths, or at distances along curved rays.
TEST(LiveTruth, WhatIsOfEachCameraHasItsName)
{
  const std::string file = "Data/Scenes/fisheye_rig.json";
  const SceneDescription scene = readScene(sourceFile(file));
  ThreadPool pool(1);
  std::set<bool> kinds;
  for (std::size_t camera = 0; camera < scene.cameras.size(); ++camera)
  {
    const std::string& own = scene.cameras[camera].name;
    const LiveQuestion question = questionOf(file, camera, 0, 0, 0);
    const View view = viewOf(question);
    const PixelTruth truth = pixelTruth(question, view.model->width() / 2, view.model->height() * 3 / 4, pool);
    std::set<std::string> names;
    std::map<std::string, double> values;
    for (const PixelValue& value : truth.values)
    {
      EXPECT_TRUE(names.insert(value.name).second) << value.name;
      values[value.name] = value.values.front();
    }
    for (const CameraDescription& other : scene.cameras)
    {
      EXPECT_EQ(names.count("correspondence_" + other.name), own == other.name ? 0u : 1u) << own << ' ' << other.name;
    }
    EXPECT_EQ(names.count("correspondence"), 0u);
    ASSERT_FALSE(truth.layers.empty()) << own;
    kinds.insert(truth.isLinear);
    const double expected = values.at(truth.isLinear ? "depth" : "distance");
    EXPECT_NEAR(truth.layers.front().depth, expected, 1e-9 * expected) << own;
  }
  EXPECT_EQ(kinds.size(), 2u);
}

TEST(LiveTruth, FlowNeedsAFrameBeside)
{
  const LiveQuestion last = questionOf("Data/Scenes/dataset_flow.json", 0, 2);
  ThreadPool pool(1);
  EXPECT_FALSE(livePicture(last, "flow_forward", 1, pool).message.empty());
  EXPECT_TRUE(livePicture(last, "flow_backward", 1, pool).message.empty());
  for (const PixelValue& value : pixelTruth(last, 48, 36, pool).values)
  {
    static const std::set<std::string> others{ "flow_forward", "sceneflow", "correspondence", "disparity",
      "disparity_forward", "disparity_backward", "depth_noisy" }; // the last one needs the whole picture
    EXPECT_EQ(std::isnan(value.values[0]), others.count(value.spec.name) == 1) << value.spec.name;
  }
}

TEST(LiveTruth, PicturesComeCoarseThenFine)
{
  const LiveQuestion question = questionOf("Data/Scenes/dataset_stereo.json", 0, 0, 200, 150);
  LiveTruth truth;
  std::mutex mutex;
  std::vector<LivePicture> received;
  truth.askPicture(question, "depth",
    [&](const LivePicture& picture)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      received.push_back(picture);
    });
  truth.wait();
  ASSERT_GE(received.size(), 2u);
  for (std::size_t i = 0; i < received.size(); ++i)
  {
    const LivePicture& one = received[i];
    EXPECT_EQ(one.step == 1, i + 1 == received.size());
    EXPECT_LT(one.step, i == 0 ? 100 : received[i - 1].step);
    EXPECT_EQ(one.picture.width, (200 + one.step - 1) / one.step);
    EXPECT_EQ(one.picture.height, (150 + one.step - 1) / one.step);
    EXPECT_LT(one.least, one.most);
  }
  std::string message;
  truth.askPicture(question, "smell", [&](const LivePicture& picture) { message = picture.message; });
  truth.wait();
  EXPECT_NE(message.find("smell"), std::string::npos);
}

TEST(LiveTruth, TheNewestQuestionHasTheLastWord)
{
  const LiveQuestion question = questionOf("Data/Scenes/dataset_stereo.json", 0, 0, 400, 300);
  LiveTruth truth;
  std::mutex mutex;
  std::vector<std::string> fine;
  PixelTruth pixel;
  for (int i = 0; i < 40; ++i)
  {
    const std::string layer = i % 2 == 0 ? "alpha" : "normal";
    truth.askPicture(question, layer,
      [&, name = layer + std::to_string(i)](const LivePicture& picture)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (picture.step == 1)
        {
          fine.push_back(name);
        }
      });
    truth.askPixel(question, i, i, [&](const PixelTruth& answer) { pixel = answer; });
  }
  truth.wait();
  ASSERT_FALSE(fine.empty());
  EXPECT_EQ(fine.back(), "normal39");
  EXPECT_EQ(pixel.column, 39);
}

TEST(LiveScene, AChangeKeepsWhatItDidNotTouch)
{
  SceneDescription scene = readScene(sourceFile("Data/Scenes/dataset_stereo.json"));
  ModelLibrary models;
  models.load(scene);
  auto first = std::make_unique<LiveScene>(scene, models);
  const LiveScene::Moment before = first->at(0);
  scene.objects[0].position = Eigen::Vector3d(1, 2, 3);
  const LiveScene second(scene, models, first.get());
  first.reset();
  const LiveScene::Moment after = second.at(0);
  EXPECT_EQ(second.at(0).state, after.state);
  EXPECT_EQ(after.state->instances[0].geometry, before.state->instances[0].geometry);
  EXPECT_EQ(after.state->instances[0].world_from_object.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_NE(before.state->instances[0].world_from_object.translation, Eigen::Vector3d(1, 2, 3));
}

TEST(LiveView, IsTheEyeOfTheView)
{
  ViewCamera camera(ViewKind::Perspective);
  WorldBox box;
  box.add(Eigen::Vector3d(-3, -1, -2));
  box.add(Eigen::Vector3d(5, 2, 4));
  camera.frame(box, 1.5);
  camera.orbit(20, 10);
  LiveQuestion question;
  question.scene = std::make_shared<LiveScene>(SceneDescription(), ModelLibrary());
  question.camera = liveCamera(camera, box);
  question.width = 300;
  question.height = 200;
  const View view = viewOf(question);
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  for (const Eigen::Vector2d& pixel : { Eigen::Vector2d(0, 0), { 10.5, 180.25 }, { 150, 100 }, { 299, 3 } })
  {
    const CameraRay ray = view.model->rayThrough(pixel);
    const WorldRay expected = camera.ray(pixel.x(), pixel.y(), 300, 200);
    EXPECT_TRUE((world_from_camera * ray.origin).isApprox(expected.origin, 1e-12));
    EXPECT_TRUE((world_from_camera.rotation * ray.direction).isApprox(expected.direction, 1e-12));
  }
  for (const Eigen::Vector3d& corner : { box.min, box.max })
  {
    const double depth = (view.camera_from_world * corner).z();
    EXPECT_GT(depth, view.near);
    EXPECT_LT(depth, view.far);
  }
  EXPECT_DOUBLE_EQ(view.far / view.near, 10000);
}

TEST(LiveView, ReachesToItsFocusAndToAllThatStands)
{
  ViewCamera view(ViewKind::Perspective);
  view.look({ 1, 2, 3 }, { 1, 2, 5 });
  EXPECT_EQ(liveCamera(view, WorldBox()).far, 2);
  WorldBox box;
  box.add(Eigen::Vector3d(0, 0, 3.5));
  box.add(Eigen::Vector3d(1, 1, 4.5));
  EXPECT_EQ(liveCamera(view, box).far, 2) << "the focus is behind all of it";
  box.add(Eigen::Vector3d(9, 9, 13));
  EXPECT_DOUBLE_EQ(liveCamera(view, box).far, 10.1);
  EXPECT_DOUBLE_EQ(liveCamera(view, box).near, 10.1 / 1e4);
}

TEST(LiveView, ACameraOfTheSceneMayBeCalledAsTheEyeIs)
{
  SceneDescription scene = readScene(sourceFile("Data/Scenes/dataset_stereo.json"));
  scene.cameras[1].name = "eye";
  ModelLibrary models;
  models.load(scene);
  LiveQuestion question;
  question.scene = std::make_shared<LiveScene>(scene, models);
  question.camera = scene.cameras[0];
  question.camera.name.clear();
  ThreadPool pool(1);
  const LiveEye eye(question, 8, pool);
  EXPECT_EQ(eye.missing("depth"), "");
  EXPECT_EQ(eye.view().camera_from_world.translation, viewOf(question).camera_from_world.translation);
}

TEST(LiveView, SeesASceneWhoseFileListsItsItems)
{
  LiveQuestion question = questionOf("Data/Scenes/appendix_b3.scene", 0, 0, 8, 6);
  ASSERT_FALSE(question.scene->description().order.empty());
  question.camera.name.clear();
  ThreadPool pool(1);
  const LiveEye eye(question, 8, pool);
  EXPECT_EQ(eye.missing("depth"), "");
}

TEST(NewestTask, WhatWaitedIsDropped)
{
  std::vector<int> done;
  bool outdated = false;
  std::promise<void> started;
  std::promise<void> go;
  NewestTask task;
  task.start(
    [&](const NewestTask::Outdated& isOutdated)
    {
      started.set_value();
      go.get_future().wait();
      outdated = isOutdated();
      done.push_back(0);
    });
  started.get_future().wait();
  for (int i = 1; i <= 100; ++i)
  {
    task.start([&done, i](const NewestTask::Outdated&) { done.push_back(i); });
  }
  go.set_value();
  task.wait();
  EXPECT_TRUE(outdated);
  EXPECT_EQ(done, (std::vector<int>{ 0, 100 }));
}

TEST(NewestTask, TheEndWaitsForNothingThatHasNotBegun)
{
  std::promise<void> started;
  int done = 0;
  {
    NewestTask task;
    task.start(
      [&](const NewestTask::Outdated& outdated)
      {
        started.set_value();
        while (!outdated())
        {
          std::this_thread::yield();
        }
        ++done;
      });
    started.get_future().wait();
  }
  EXPECT_EQ(done, 1);
}
} // namespace
