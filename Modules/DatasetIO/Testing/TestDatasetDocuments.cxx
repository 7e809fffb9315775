// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkLayerReader.h"
#include "dgtkObjectDocuments.h"
#include "dgtkTestImages.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
// Pixels; rounding of numbers of the size of an image.
constexpr double pixelTolerance = 1e-9;

Eigen::Matrix4d perspective(double f, double aspect, double near, double far)
{
  Eigen::Matrix4d p = Eigen::Matrix4d::Zero(); // gluPerspective, f = cot(fovY / 2)
  p(0, 0) = f / aspect;
  p(1, 1) = f;
  p(2, 2) = (far + near) / (near - far);
  p(2, 3) = 2 * far * near / (near - far);
  p(3, 2) = -1;
  return p;
}

} // namespace

// Section 4.3: viewport matrix * K * [R|t] takes world points to pixels with y up.
TEST(Calibration, CameraMatrixGivesPixelsWithYUp)
{
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity(); // a quarter turn about y, then moved
  view.topLeftCorner<3, 3>() << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  view.topRightCorner<3, 1>() << 0.25, -0.5, -7;
  const Eigen::Matrix4d projection = perspective(1.75, 4.0 / 3, 0.1, 1000);
  const TemporaryFolder folder;
  writeFile(folder.path("c.txt"), calibrationText(makeCalibration(projection, view, 640, 480)));
  const Calibration read = readCalibration(folder.path("c.txt"));
  for (const Eigen::Vector3d& world :
    { Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-0.3, 0.7, 0.1), Eigen::Vector3d(0, 0, 0) })
  {
    const Eigen::Vector3d pixel = read.cameraMatrix() * Eigen::Vector4d(world.x(), world.y(), world.z(), 1);
    // the same by hand, with equations 4.6 and OpenGL's viewport
    const Eigen::Vector3d eye = view.topLeftCorner<3, 3>() * world + view.topRightCorner<3, 1>();
    const double x = 320 + 320 * (1.75 / (4.0 / 3)) * eye.x() / -eye.z();
    const double y = 240 + 240 * 1.75 * eye.y() / -eye.z();
    EXPECT_NEAR(pixel.x() / pixel.z(), x, pixelTolerance);
    EXPECT_NEAR(pixel.y() / pixel.z(), y, pixelTolerance);
    EXPECT_NEAR(pixel.z(), -eye.z(), pixelTolerance);
  }
}

TEST(Calibration, OrthographicCamerasKeepTheForm)
{
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity(); // glOrtho(-1, 3, -2, 2, 0, 10)
  projection.topRows<3>() << 0.5, 0, 0, -0.5, 0, 0.5, 0, 0, 0, 0, -0.2, -1;
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topRightCorner<3, 1>() << 1, 2, -5;
  const Calibration calibration = makeCalibration(projection, view, 400, 200);
  const Eigen::Vector3d world(0.5, -1, 2);
  const Eigen::Vector3d pixel = calibration.cameraMatrix() * Eigen::Vector4d(world.x(), world.y(), world.z(), 1);
  EXPECT_DOUBLE_EQ(pixel.z(), 1);
  EXPECT_DOUBLE_EQ(pixel.x(), 200 + 200 * (0.5 * 1.5 - 0.5));
  EXPECT_DOUBLE_EQ(pixel.y(), 100 + 100 * (0.5 * 1.0));
}

TEST(Calibration, TextIsTheThesisForm)
{
  const Calibration calibration = makeCalibration(perspective(2, 2, 1, 3), Eigen::Matrix4d::Identity(), 8, 4);
  EXPECT_EQ(
    calibrationText(calibration), "K\n1 0 0\n0 2 0\n0 0 -1\nR|t\n1 0 0 0\n0 1 0 0\n0 0 1 0\nViewport\n0 0 8 4\n");
}

TEST(Calibration, NumbersReadBackExactlyInAnyLocale)
{
  const TemporaryFolder folder;
  Calibration calibration = makeCalibration(testContext().projection, testContext().modelView, 3, 2);
  calibration.K(0, 0) = 0.1 + 0.2;
  calibration.K(1, 2) = 1e-300;
  calibration.Rt(2, 3) = -1.0 / 3;
  const char* const changed = std::setlocale(LC_ALL, "de_DE.UTF-8"); // where it is installed
  writeFile(folder.path("c.txt"), calibrationText(calibration));
  const Calibration read = readCalibration(folder.path("c.txt"));
  std::setlocale(LC_ALL, "C");
  (void)changed;
  EXPECT_EQ(read.K, calibration.K);
  EXPECT_EQ(read.Rt, calibration.Rt);
}

TEST(Calibration, RefusalsNameTheLine)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("c.txt");
  const auto message = [&](const std::string& text)
  {
    writeFile(path, text);
    return thrownBy<InputError>([&] { readCalibration(path); });
  };
  EXPECT_EQ(message("K\n1 2 3\n4 x 6\n"), path + ":3: is not a calibration (expected a number, found 'x')");
  EXPECT_EQ(message("K\n1 2 3\n4 nan 6\n"), path + ":3: is not a calibration (expected a number, found 'nan')");
  EXPECT_EQ(message(""), path + ":1: is not a calibration (expected 'K', found the end of the file)");
}

TEST(Objects, RoundTrip)
{
  const TemporaryFolder folder;
  const std::string text = objectsText({ { 2, "b\xff", "", 2, "m.obj", 7 }, { 1, "\xc3\xa4", "tree", 1, "t.ac", 12 } });
  EXPECT_EQ(text,
    "{\n  \"objects\": [\n"
    "    {\"id\": 1, \"name\": \"\xc3\xa4\", \"class\": \"tree\", \"class_id\": 1, \"model\": \"t.ac\", "
    "\"triangles\": 12, \"static\": false, \"deforming\": false},\n"
    "    {\"id\": 2, \"name\": \"b\xee\xbf\xbf\", \"class\": \"\", \"class_id\": 2, \"model\": "
    "\"m.obj\", \"triangles\": 7, \"static\": false, \"deforming\": false}\n"
    "  ],\n  \"classes\": [\n    {\"id\": 1, \"name\": \"tree\"},\n    {\"id\": 2, \"name\": \"\"}\n  ]\n}\n");
  writeFile(folder.path("objects.json"), text);
  EXPECT_EQ(objectsText(readObjects(folder.path("objects.json"))), text);
}

TEST(Objects, ClassesWithoutObjectsAreListed)
{
  const TemporaryFolder folder;
  const std::vector<ObjectRecord> objects{ { 1, "o", "tree", 40, "t.ac", 12 } };
  const auto read = [&](const std::string& text)
  {
    writeFile(folder.path("objects.json"), text);
    std::string found;
    for (const ClassRecord& one : readClasses(folder.path("objects.json")))
    {
      found += std::to_string(one.id) + one.name + ' ';
    }
    return found;
  };
  EXPECT_EQ(read(objectsText(objects, { { 65535, "sky" }, { 40, "tree" }, { 7, "car" } })), "7car 40tree 65535sky ");
  std::string old = objectsText(objects);
  old.replace(old.find(",\n  \"classes\""), std::string::npos, "\n}\n");
  EXPECT_EQ(read(old), "40tree ");
}

TEST(ManifestDocument, SaysAMeaningThatUnitAndFrameDoNotImply)
{
  Manifest manifest;
  manifest.layers = { { { "curvature", PixelType::Float64, 1, "1 / scene units", "", "nan", "", Meaning::Direction },
                        "npy" },
    { { "depth", PixelType::Float64, 1, "scene units", "camera", "+inf", "", Meaning::Depth }, "npy" } };
  const TemporaryFolder folder;
  const std::string text = manifestText(manifest);
  EXPECT_EQ(text.find("meaning"), text.rfind("meaning")) << "of one only";
  writeFile(folder.path("manifest.json"), text);
  const Manifest read = readManifest(folder.path("manifest.json"));
  EXPECT_EQ(read.layers[0].spec.meaning, Meaning::Direction);
  EXPECT_EQ(read.layers[1].spec.meaning, Meaning::Depth);
}

TEST(ManifestDocument, RoundTrip)
{
  Manifest manifest;
  manifest.version = "0.1.0";
  manifest.requestHash = "abc";
  manifest.request = { { "scene", "a.scene" }, { "layers", "depth" } };
  manifest.units = "metres";
  manifest.inputs = { { "b.ac", 5, std::string(64, 'b') }, { "a.scene", 9, std::string(64, 'a') } };
  manifest.layers = { { specOf(PixelType::Float64, 1), "npy" } };
  manifest.files = { { "z/depth/000001.npy", 1, std::string(64, '1'), "depth", "z", 1 },
    { "cameras.json", 2, std::string(64, '2'), "", "", -1 } };
  const std::string text = manifestText(manifest);
  const TemporaryFolder folder;
  writeFile(folder.path("manifest.json"), text);
  const Manifest read = readManifest(folder.path("manifest.json"));
  EXPECT_EQ(manifestText(read), text);
  EXPECT_EQ(read.request, manifest.request);
  ASSERT_EQ(read.files.size(), 2u);
  EXPECT_EQ(read.files[0].path, "cameras.json");
  EXPECT_EQ(read.files[1].frame, 1);
  EXPECT_EQ(read.layers[0].spec.type, PixelType::Float64);
  EXPECT_EQ(read.inputs[0].path, "a.scene");
}

TEST(Documents, RefusalsNameThePlace)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.json");
  const auto cameras = [&](const std::string& text)
  {
    writeFile(path, text);
    return thrownBy<InputError>([&] { readCameras(path); });
  };
  EXPECT_THAT(cameras("{\n\n["), HasSubstr(path + ":3: is not valid JSON"));
  EXPECT_EQ(cameras("{}"), path + ":1: cameras is missing");
  EXPECT_EQ(cameras("[1]"), path + ":1: has the wrong type (expected an object, found a list of 1)");
  EXPECT_EQ(cameras("{\"cameras\": [{\"name\": 3}]}"),
    path + ":1: cameras[0].name has the wrong type (expected a text in quotes, found 3)");
  EXPECT_THAT(cameras("{\"cameras\": [{\"name\": \"a\", \"frame\": 99999999999}]}"),
    HasSubstr("cameras[0].frame is out of range (expected a whole number from -2147483648 to 2147483647"));
  writeFile(path, "{}");
  EXPECT_EQ(thrownBy<InputError>([&] { readManifest(path); }), path + ":1: is not the manifest of a DGTk dataset");
  EXPECT_THAT(thrownBy<InputError>([&] { readObjects("/no/such"); }), HasSubstr("/no/such: cannot be read"));
}

TEST(Documents, WritingDescribesTheFile)
{
  const TemporaryFolder folder;
  const DatasetFile file = writeDocument(folder.path(), "a.txt", "hello", "calibration", "left", 4);
  EXPECT_EQ(contentsOf(folder.path("a.txt")), "hello");
  EXPECT_EQ(file.path, "a.txt");
  EXPECT_EQ(file.bytes, 5u);
  EXPECT_EQ(file.sha256, Sha256::ofFile(folder.path("a.txt")));
  EXPECT_EQ(file.frame, 4);
}

TEST(Documents, RealNumbersHaveAPointAndCountsHaveNone)
{
  CameraRecord camera;
  camera.name = "c";
  camera.width = 640;
  camera.K << 1e22, 0, 320, 0, 0.5, 240, 0, 0, 1;
  camera.t << -0.0, -3, 1e-9;
  camera.model = "pinhole";
  camera.numbers["distortion"] = { 0, 2 };
  camera.near = 1;
  camera.far = 100;
  const std::string cameras = camerasText({ camera });
  for (const char* const part : { "\"width\": 640,", "\"K\": [[1e+22, 0.0, 320.0], [0.0, 0.5, 240.0], [0.0, 0.0, 1.0]]",
         "\"t\": [-0.0, -3.0, 1e-09]", "\"distortion\": [0.0, 2.0]", "\"near\": 1.0", "\"far\": 100.0" })
  {
    EXPECT_THAT(cameras, HasSubstr(part));
  }
  BoxRecord box;
  box.id = 3;
  box.visible = Eigen::Vector4d(1, 2, 3, 4);
  box.projected = Eigen::Vector4d(1, 2, 3.5, 4);
  box.rigid = true;
  const std::string boxes = boxesText("left", 7, { box });
  for (const char* const part : { "\"id\": 3,", "\"box_visible\": [1, 2, 3, 4]",
         "\"box_projected\": [1.0, 2.0, 3.5, 4.0]", "\"scale\": [1.0, 1.0, 1.0]", "\"visible_fraction\": 0.0" })
  {
    EXPECT_THAT(boxes, HasSubstr(part));
  }
}

TEST(ObjectDocuments, ReadBackAsWritten)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.json");
  BoxRecord box;
  box.id = 3;
  box.name = "mill";
  box.objectClass = "building";
  box.pixelsVisible = 5;
  box.pixelsAmodal = 8;
  box.pixelsWhole = 11;
  box.visible = Eigen::Vector4d(1, 2, 3, 4);
  box.whole = Eigen::Vector4d(-3, 2, 13, 4);
  box.projected = Eigen::Vector4d(0.5, -2.25, 1e9, 4);
  box.rigid = true;
  box.R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  box.t = Eigen::Vector3d(0.1, -2, 3);
  box.scale = Eigen::Vector3d(-1, 2, 3);
  box.corners(7, 2) = 6;
  BoxRecord sheared;
  sheared.id = 4;
  const std::string boxes = boxesText("left", 7, { box, sheared });
  writeFile(path, boxes);
  EXPECT_EQ(boxesText("left", 7, readBoxes(path)), boxes);
  EXPECT_FALSE(readBoxes(path)[1].rigid);
  EXPECT_EQ(readBoxes(path)[0].whole, box.whole);
  std::string old = boxes; // without what version 1 did not have
  for (const char* const key : { "\"pixels_whole\"", "\"box_whole\"" })
  {
    for (std::size_t at = old.find(key); at != std::string::npos; at = old.find(key))
    {
      old.erase(at, old.find('\n', at) + 1 - at);
    }
  }
  writeFile(path, old);
  EXPECT_EQ(readBoxes(path)[0].pixelsWhole, 0u);
  EXPECT_FALSE(readBoxes(path)[0].whole.has_value());
  EXPECT_EQ(readBoxes(path)[0].visible, box.visible);

  const std::string masks = amodalText(4, 2, { { 1, { 0, 3, 5 } }, { 9, { 8 } } });
  writeFile(path, masks);
  const AmodalMasks amodal = readAmodal(path);
  EXPECT_EQ(amodalText(amodal.width, amodal.height, amodal.masks), masks);

  PointRecord point;
  point.x = Eigen::Vector3d(1, 2.5, -3);
  point.object = 2;
  point.triangle = 7;
  point.track = { { 1, 0.5, 1.5 }, { 0, 2.25, 3 } };
  const std::string points = pointsText(4, { "left", "right" }, { point, PointRecord() });
  writeFile(path, points);
  const TrackedPoints read = readPoints(path);
  EXPECT_EQ(pointsText(read.frame, read.cameras, read.points), points);
}

TEST(ObjectDocuments, RefusalsNameThePlace)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.json");
  const auto amodal = [&](const std::string& counts)
  {
    writeFile(path, "{\"width\": 4, \"height\": 2, \"masks\": [{\"id\": 1, \"counts\": " + counts + "}]}");
    return thrownBy<InputError>([&] { readAmodal(path); });
  };
  EXPECT_EQ(amodal("[0, 8]"), "");
  EXPECT_EQ(amodal("[0, 9]"), path + ":1: masks[0] is longer than the image");
  EXPECT_EQ(amodal("[3, 18446744073709551615]").find(path + ":1: masks[0].counts[1] is out of range"), 0u);
  EXPECT_EQ(amodal("[0, 7]"), path + ":1: masks[0] ends before the image");
  EXPECT_THAT(amodal("[-1]"), HasSubstr("masks[0].counts[0] is out of range"));
  for (const auto& [size, place] :
    { std::pair(R"("width": 0, "height": 2)", "width"), std::pair(R"("width": 4, "height": 0)", "height"),
      std::pair(R"("width": -4, "height": 2)", "width"), std::pair(R"("width": 4, "height": 2.5)", "height"),
      std::pair(R"("width": 2147483648, "height": 2)", "width"), std::pair(R"("width": 4)", "height") })
  {
    writeFile(path, "{" + std::string(size) + ", \"masks\": []}");
    EXPECT_THAT(thrownBy<InputError>([&] { readAmodal(path); }), HasSubstr(path + ":1: " + place)) << size;
  }
  writeFile(path, "{\"frame\": 0, \"cameras\": [], \"points\": [{\"x\": [1, 2]}]}");
  EXPECT_THAT(thrownBy<InputError>([&] { readPoints(path); }), HasSubstr("points[0].x has the wrong type"));
  writeFile(path, "{\"objects\": [{\"id\": 0}]}");
  EXPECT_THAT(thrownBy<InputError>([&] { readBoxes(path); }), HasSubstr("objects[0].id is out of range"));
}

TEST(DatasetDocuments, ClassesObjectsAndPosesReadBack)
{
  const TemporaryFolder folder;
  ObjectRecord object{ 2, "o", "car", 3, "t.ac", 12 };
  object.isStatic = true;
  object.geometry = std::string(64, 'a');
  object.geometryFile = "models/aaaaaaaaaaaaaaaa.ply";
  ClassRecord car{ 3, "car" };
  car.supercategory = "vehicle";
  car.thing = false;
  car.color = { 1, 2, 255 };
  car.keypoints = { "nose", "tail" };
  car.skeleton = { { 1, 2 } };
  writeFile(folder.path("objects.json"), objectsText({ object }, { car, { 1, "tree" } }));
  const ObjectRecord read = readObjects(folder.path("objects.json")).at(0);
  EXPECT_TRUE(read.isStatic);
  EXPECT_FALSE(read.deforming);
  EXPECT_EQ(read.geometry, object.geometry);
  EXPECT_EQ(read.geometryFile, object.geometryFile);
  const std::vector<ClassRecord> classes = readClasses(folder.path("objects.json"));
  ASSERT_EQ(classes.size(), 2u);
  EXPECT_FALSE(classes[0].thing);
  EXPECT_EQ(classes[1].supercategory, "vehicle");
  EXPECT_EQ(classes[1].thing, false);
  EXPECT_EQ(classes[1].color, car.color);
  EXPECT_EQ(classes[1].keypoints, car.keypoints);
  EXPECT_EQ(classes[1].skeleton, car.skeleton);

  PoseRecord sheared;
  sheared.frame = 7;
  sheared.id = 2;
  sheared.visible = false;
  sheared.matrix(0, 1) = 0.1 + 0.2;
  sheared.t = { 1, 2, 3 };
  PoseRecord first;
  first.id = 2;
  first.rigid = true;
  first.scale = { -1, 1, 2 };
  PoseRecord second = first;
  second.id = 1;
  writeFile(folder.path("poses.json"), posesText({ sheared, first, second }));
  const std::vector<PoseRecord> poses = readPoses(folder.path("poses.json"));
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[0].id, 1u);
  EXPECT_EQ(poses[1].scale, first.scale);
  EXPECT_TRUE(poses[1].rigid);
  EXPECT_EQ(poses[2].frame, 7);
  EXPECT_FALSE(poses[2].visible);
  EXPECT_FALSE(poses[2].rigid);
  EXPECT_EQ(poses[2].matrix, sheared.matrix);
  EXPECT_EQ(poses[2].t, sheared.t);
}

TEST(DatasetDocuments, WhatTheFirstDatasetsDoNotSay)
{
  const TemporaryFolder folder;
  writeFile(folder.path("objects.json"),
    R"({"objects": [{"id": 1, "name": "o", "class": "c", "class_id": 4, "model": "m", "triangles": 1}]})");
  EXPECT_EQ(readObjects(folder.path("objects.json")).at(0).geometry, "");
  EXPECT_EQ(readClasses(folder.path("objects.json")).at(0).name, "c");
  Manifest manifest;
  writeFile(folder.path("manifest.json"), manifestText(manifest));
  EXPECT_EQ(readManifest(folder.path("manifest.json")).metresPerUnit, 0);
  manifest.metresPerUnit = 0.001;
  manifest.fps = 12.5;
  manifest.info = { { "license", "CC0" } };
  std::string text = manifestText(manifest);
  writeFile(folder.path("manifest.json"), text);
  EXPECT_EQ(readManifest(folder.path("manifest.json")).metresPerUnit, 0.001);
  EXPECT_EQ(readManifest(folder.path("manifest.json")).fps, 12.5);
  EXPECT_EQ(readManifest(folder.path("manifest.json")).info, manifest.info);
  for (const char* key : { "\"metres_per_unit\"", "\"fps\"", "\"info\"" })
  {
    text.replace(text.find(key) + 1, 1, "_"); // of no meaning to anybody
  }
  writeFile(folder.path("manifest.json"), text);
  const Manifest old = readManifest(folder.path("manifest.json"));
  EXPECT_EQ(old.metresPerUnit, 0);
  EXPECT_EQ(old.fps, 0);
  EXPECT_TRUE(old.info.empty());
}

TEST(DatasetDocuments, KeypointsOfBoxesReadBack)
{
  const TemporaryFolder folder;
  BoxRecord with;
  with.id = 1;
  with.keypoints = { { "nose", { 1, 2, 3 }, Eigen::Vector2d(4.5, -6), 3 }, { "tail", { 0, 0, -1 }, std::nullopt, 5 } };
  BoxRecord without;
  without.id = 2;
  const std::string text = boxesText("left", 0, { with, without });
  EXPECT_EQ(text.find("keypoints"), text.rfind("keypoints")) << text;
  writeFile(folder.path("b.json"), text);
  const std::vector<BoxRecord> read = readBoxes(folder.path("b.json"));
  ASSERT_EQ(read.at(0).keypoints.size(), 2u);
  EXPECT_EQ(read[0].keypoints[0].name, "nose");
  EXPECT_EQ(read[0].keypoints[0].x, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(read[0].keypoints[0].pixel, Eigen::Vector2d(4.5, -6));
  EXPECT_EQ(read[0].keypoints[0].visibility, 3);
  EXPECT_FALSE(read[0].keypoints[1].pixel);
  EXPECT_TRUE(read[1].keypoints.empty());
}
