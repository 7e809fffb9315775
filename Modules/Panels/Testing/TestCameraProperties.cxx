// SPDX-License-Identifier: BSD-3-Clause
// The panel of properties: every row of cameras.
#include "dgtkPropertiesTest.h"

#include "dgtkCameraEntry.h"
#include "dgtkPortableMath.h"
#include "dgtkScenePlaces.h"
#include "dgtkStrangeCamera.h"

#include <cmath>
#include <memory>

namespace
{
using namespace dgtk;
using V = Eigen::Vector3d;
using Kind = SceneItem::Kind;

/// A model of cameras that has parameters of its own.
CameraEntry entry()
{
  CameraParameter xi{ "panelXi", "px", "a number that moves", { 0, 5, false, false, "a number from 0 to 5" }, { 1 } };
  xi.moves = true;
  CameraParameter list{ "panelList", "", "a list", { -1, 1, false, false, "a number from -1 to 1" }, { 0.5, 0.25 } };
  list.counts = { 2 };
  CameraParameter file{ "panelFile", "", "a file" };
  file.kind = CameraParameter::Kind::File;
  return { { xi, list, file }, [](const CameraParameters& of) -> std::shared_ptr<const CameraModel> {
            return std::make_shared<test::StrangeCamera>(of, "panels");
          } };
}
const CameraEntry ofPanels = entry();
const bool added = addCamera({ "panels", "for a test", &ofPanels });

class CameraProperties : public test::PropertiesTest
{
};

TEST_F(CameraProperties, RowsOfCameras)
{
  this->select(Kind::Camera, 0);
  EXPECT_EQ(this->rows(), R"(Name | name eye
Model | pinhole
Eye, m | eye 0 -5 1
Look at, m | lookAt 0 0 1
Up | up 0 0 1
Lens | lens by its field of view of 2
Field of view, ° | fovY 40
Aspect (0: square) | aspect 1.5
Distortion | distortion 0 0 0 0
Near, m | near 0.5
Far, m | far 50
Size, pixels | size 640 480
)");
  SceneDescription wanted = this->scene();
  CameraDescription& eye = wanted.cameras[0];
  this->type("eye.0", "2");
  eye.eye = V(2, -5, 1);
  this->type("lookAt.1", "3");
  eye.lookAt = V(0, 3, 1);
  this->type("up.0", "0.5");
  eye.up = V(0.5, 0, 1);
  this->type("fovY.0", "50");
  eye.fovY = 50;
  this->type("aspect.0", "2");
  eye.aspect = 2;
  this->type("near.0", "0.25");
  eye.near = 0.25;
  this->type("far.0", "60");
  eye.far = 60;
  this->type("size.0", "320");
  this->type("size.1", "200");
  eye.width = 320;
  eye.height = 200;
  EXPECT_EQ(toJson(this->scene(), ""), toJson(wanted, ""));
  this->select(Kind::Camera, 2);
  EXPECT_EQ(this->rows(), R"(Name | name flat
Model | orthographic
Eye, m | eye 0 -5 1
Look at, m | lookAt 0 0 1
Up | up 0 0 1
View height, m | viewHeight 7
Near, m | near 0.1
Far, m | far 1000
Size, pixels | size 0 0
)");
  this->type("viewHeight.0", "9");
  EXPECT_EQ(this->scene().cameras[2].viewHeight.at(0), 9);
}

/// Beside a scroll bar, in the dock as it is at the first start.
TEST_F(CameraProperties, AllFieldsFitTheUsualDock)
{
  constexpr int usualWidth = 300;
  this->State->document().edit("Lens",
    [](SceneDescription& scene)
    {
      std::vector<Track<double>>& numbers = scene.cameras[1].parameters["distortion"].numbers;
      numbers.assign(14, Track<double>{ 0.001 });
    });
  for (const SceneItems& items : { SceneItems{ { Kind::Camera, 1 } },
         SceneItems{ { Kind::Object, 0 }, { Kind::Object, 1 }, { Kind::Light, 0 }, { Kind::Light, 1 } } })
  {
    this->State->select(items);
    EXPECT_LE(this->Panel->widget()->minimumSizeHint().width(), usualWidth) << this->rows();
  }
  this->select(Kind::Camera, 1);
  EXPECT_NE(this->field<QLineEdit>("distortion.13"), nullptr);
}

TEST_F(CameraProperties, ARefusalNamesNoLineOfTheFile)
{
  this->select(Kind::Camera, 0);
  this->type("far.0", "0.1");
  EXPECT_EQ(this->Failure.rfind("camera 'eye': ", 0), 0u) << this->Failure;
  EXPECT_EQ(this->scene().cameras[0].far, 50);
  this->State->document().clear();
  this->State->document().addCamera({});
  this->select(Kind::Camera, 0);
  this->type("far.0", "-1");
  EXPECT_EQ(this->Failure.rfind("camera 'Camera0': ", 0), 0u) << this->Failure;
}

TEST_F(CameraProperties, SizesAreGivenWhole)
{
  this->select(Kind::Camera, 2);
  struct Row
  {
    const char *name, *text;
    int width, height;
  };
  for (const Row& row :
    { Row{ "size.0", "400", 400, 300 }, Row{ "size.0", "0", 0, 0 }, Row{ "size.1", "300", 400, 300 },
      Row{ "size.1", "0", 0, 0 }, Row{ "size.0", "1", 1, 1 }, Row{ "size.1", "7", 1, 7 } })
  {
    this->type(row.name, row.text);
    EXPECT_EQ(this->scene().cameras[2].width, row.width) << row.name << ' ' << row.text;
    EXPECT_EQ(this->scene().cameras[2].height, row.height) << row.name << ' ' << row.text;
  }
}

TEST_F(CameraProperties, LensesByAngleAndByMatrix)
{
  this->select(Kind::Camera, 1);
  EXPECT_EQ(this->rows(), R"(Name | name posed
Model | pinhole
Position, m | position 1 2 3
Rotation, ° | rotation 0 0 0
Quaternion | orientation 1 0 0 0
Lens | lens by its matrix K of 2
fx, fy, pixels | focal 90 80
cx, cy, pixels | principal 50 40
Skew, pixels | skew 1
Distortion | distortion 0 0 0 0
Near, m | near 0.1
Far, m | far 1000
Size, pixels | size 100 80
)");
  this->type("focal.0", "100");
  this->type("focal.1", "50");
  this->type("principal.0", "51");
  this->type("principal.1", "42");
  this->type("skew.0", "2");
  Eigen::Matrix3d K;
  K << 100, 2, 51, 0, 50, 42, 0, 0, 1;
  EXPECT_EQ(*this->scene().cameras[1].K, K);
  this->type("position.1", "-2");
  EXPECT_EQ(this->scene().cameras[1].position.at(0), V(1, -2, 3));
  this->choose("lens", 0);
  EXPECT_EQ(this->Failure, "A field of view has its principal point in the middle of the image and no skew: set cx, cy "
                           "to 50, 40 and the skew to 0 first.");
  EXPECT_EQ(*this->scene().cameras[1].K, K);
  EXPECT_EQ(this->field<QComboBox>("lens")->currentIndex(), 1);
  this->type("principal.0", "50");
  this->type("principal.1", "40");
  this->type("skew.0", "0");
  this->choose("lens", 0);
  ASSERT_FALSE(this->scene().cameras[1].K);
  EXPECT_NEAR(this->scene().cameras[1].fovY.at(0), 2 * std::atan(40. / 50) * 180 / pi, 1e-9);
  EXPECT_DOUBLE_EQ(this->scene().cameras[1].aspect, 0.5 * 100 / 80);
  this->choose("lens", 1);
  ASSERT_TRUE(this->scene().cameras[1].K);
  K << 100, 0, 50, 0, 50, 40, 0, 0, 1;
  EXPECT_LT((*this->scene().cameras[1].K - K).norm(), 1e-9) << *this->scene().cameras[1].K;
  EXPECT_EQ(this->scene().cameras[1].aspect, 0);
  EXPECT_EQ(this->scene().cameras[1].fovY.at(0), CameraDescription().fovY.at(0));
  this->type("focal.0", "50");
  this->choose("lens", 0);
  EXPECT_EQ(this->scene().cameras[1].aspect, 0) << "square pixels";
  // Without a size of its own the camera gets the usual one; an angle with keys stays.
  this->State->document().edit("Size",
    [](SceneDescription& scene)
    {
      scene.cameras[1].width = 0;
      scene.cameras[1].height = 0;
    });
  this->choose("lens", 1);
  EXPECT_EQ(this->scene().cameras[1].width, usualImageSize[0]);
  EXPECT_EQ(this->scene().cameras[1].height, usualImageSize[1]);
  this->choose("lens", 0);
  this->State->document().edit("Keys",
    [](SceneDescription& scene) {
      scene.cameras[1].fovY.keys = { { 0, 30 }, { 4, 40 } };
    });
  this->choose("lens", 1);
  EXPECT_EQ(this->Failure, "The field of view has key frames, which a matrix cannot have: remove them first.");
  EXPECT_FALSE(this->scene().cameras[1].K);
}

TEST_F(CameraProperties, LensesOfAllModelsShowTheSameEitherWay)
{
  struct Row
  {
    const char *model, *parameter;
    std::vector<double> numbers;
    double angle; ///< of half of 100 pixels at a focal length of 100
  };
  const double sphere = std::atan(0.5) + std::asin(0.25 / std::sqrt(1.25)); // sin = (cos + 1/2) / 2
  for (const Row& row : { Row{ "pinhole", "distortion", { 0.1, 0.01, 0.02, 0.03 }, std::atan(0.5) },
         Row{ "fisheye", "distortion", { 0.02, -0.004, 0.0006, -5e-05 }, 0.5 },
         Row{ "omnidirectional", "xi", { 0.5 }, sphere }, Row{ "double-sphere", "xi", { 0.2 }, 0 },
         Row{ "eucm", "alpha", { 0.6 }, 0 } })
  {
    this->State->document().edit("Model",
      [&](SceneDescription& scene)
      {
        CameraDescription& camera = scene.cameras[1];
        camera.model = row.model;
        camera.parameters.clear();
        camera.parameters[row.parameter].numbers.assign(row.numbers.begin(), row.numbers.end());
        camera.width = 120;
        camera.height = 100;
        camera.K = Eigen::Matrix3d::Identity();
        *camera.K << 80, 0, 60, 0, 100, 50, 0, 0, 1;
      });
    this->select(Kind::Camera, 1);
    const Eigen::Matrix3d K = *this->scene().cameras[1].K;
    this->choose("lens", 0);
    ASSERT_FALSE(this->scene().cameras[1].K) << row.model << ' ' << this->Failure;
    if (row.angle > 0)
    {
      EXPECT_NEAR(this->scene().cameras[1].fovY.value, 2 * row.angle * 180 / pi, 1e-9) << row.model;
    }
    this->choose("lens", 1);
    ASSERT_TRUE(this->scene().cameras[1].K) << row.model;
    EXPECT_LT((*this->scene().cameras[1].K - K).norm(), 1e-9) << row.model << '\n' << *this->scene().cameras[1].K;
  }
}

TEST_F(CameraProperties, WhatAFieldOfViewCannotSayStaysAMatrix)
{
  const auto refusalOf = [this](const std::function<void(CameraDescription&)>& change, int lens)
  {
    this->State->document().edit("Lens",
      [&](SceneDescription& scene)
      {
        CameraDescription& camera = scene.cameras[1];
        camera.model = "fisheye";
        camera.width = camera.height = 640;
        camera.K = Eigen::Matrix3d(V(175, 175, 1).asDiagonal());
        camera.K->topRightCorner<2, 1>().setConstant(320);
        change(camera);
      });
    this->select(Kind::Camera, 1);
    const std::string before = toJson(this->scene(), "");
    this->Failure.clear();
    this->choose("lens", lens);
    EXPECT_EQ(toJson(this->scene(), ""), before);
    return this->Failure;
  };
  const std::string wide = "A field of view is below 180 degrees: a wider lens needs its matrix.";
  EXPECT_EQ(refusalOf([](CameraDescription&) {}, 0), wide);
  EXPECT_EQ(refusalOf([](CameraDescription& camera) { (*camera.K)(1, 1) = 10; }, 0), wide) << "more than all around";
  const auto moving = [](CameraDescription& camera)
  {
    camera.model = "omnidirectional";
    camera.parameters["xi"].numbers = { 1.0 };
    camera.parameters["xi"].numbers[0].keys = { { 0, 1.0 }, { 4, 0.5 } };
  };
  const std::string moves =
    "xi has key frames, so a matrix and a field of view do not say the same: remove them first.";
  EXPECT_EQ(refusalOf(moving, 0), moves);
  EXPECT_EQ(refusalOf(
              [&](CameraDescription& camera)
              {
                moving(camera);
                camera.K.reset();
              },
              1),
    moves);
}

TEST_F(CameraProperties, ParametersOfACamerasModel)
{
  ASSERT_TRUE(added);
  this->State->document().edit("Camera",
    [](SceneDescription& scene)
    {
      CameraDescription camera = scene.cameras[2];
      camera.name = "own";
      camera.model = "panels";
      camera.viewHeight = CameraDescription().viewHeight;
      camera.parameters["panelXi"].numbers = { 2.0 };
      camera.parameters["panelXi"].numbers[0].keys = { { 0, 1.0 }, { 4, 3.0 } };
      camera.parameters["panelFile"].file = "a.npy";
      scene.cameras.push_back(camera);
    });
  this->select(Kind::Camera, 3);
  this->State->setFrame(2);
  EXPECT_EQ(this->rows(), R"(Name | name own
Model | panels
Eye, m | eye 0 -5 1
Look at, m | lookAt 0 0 1
Up | up 0 0 1
PanelXi, px | panelXi 2
PanelList | panelList 0.5 0.25
PanelFile | a.npy
Near, m | near 0.1
Far, m | far 1000
Size, pixels | size 0 0
)");
  this->type("panelXi.0", "4");
  this->type("panelList.1", "-1");
  EXPECT_EQ(this->Failure, "");
  const auto& own = this->scene().cameras[3].parameters;
  ASSERT_EQ(own.at("panelXi").numbers.at(0).keys.size(), 3u);
  EXPECT_EQ(own.at("panelXi").numbers[0].at(2), 4);
  EXPECT_EQ(own.at("panelXi").numbers[0].at(4), 3);
  ASSERT_EQ(own.at("panelList").numbers.size(), 2u);
  EXPECT_EQ(own.at("panelList").numbers[0].at(2), 0.5);
  EXPECT_EQ(own.at("panelList").numbers[1].at(2), -1);
  this->State->document().edit("Smooth",
    [](SceneDescription& scene)
    {
      Track<double>& track = scene.cameras[3].parameters["panelXi"].numbers[0];
      track.keys = { { 0, 4.0 }, { 4, 0.0 }, { 8, 0.0 } };
      track.interpolation = Interpolation::Smooth;
    });
  this->State->setFrame(6);
  EXPECT_NE(this->rows().find("panelXi 0\n"), std::string::npos) << "within its keys, as the lens has it";
}
} // namespace
