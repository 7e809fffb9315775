// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkStrangeCamera.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

using namespace dgtk;
using testing::HasSubstr;

// A model of a program of its own, with each kind of parameter.

namespace
{
std::shared_ptr<const CameraModel> makeStrange(const CameraParameters& of)
{
  if (of.numbers.at("xi") == of.numbers.at("distortion"))
  {
    throw UsageError("xi and distortion are the same");
  }
  return std::make_shared<test::StrangeCamera>(of);
}

CameraParameter coefficients()
{
  CameraParameter parameter{ "distortion", "", "coefficients", { -9, 9, true, true, "numbers within 9" },
    { 0, 0, 0, 0 } };
  parameter.counts = { 1, 4, 5 };
  return parameter;
}

CameraParameter file()
{
  CameraParameter parameter{ "rays", "", "table" };
  parameter.kind = CameraParameter::Kind::File;
  return parameter;
}

const CameraEntry strange = {
  { coefficients(), { "xi", "", "has to be given" }, fieldOfViewParameter(), matrixParameter(), file() }, &makeStrange
};
const bool added = addCamera({ "strange", "for a test", &strange });

std::string refusalOf(const std::string& model, const CameraParameters& of)
{
  return test::thrownBy<UsageError>([&] { makeCamera(model, of); });
}

CameraParameters whole() { return { 4, 3, std::nullopt, { { "xi", { 2 } } }, { { "rays", "a.npy" } } }; }
} // namespace

TEST(CameraRegistry, HasTheModelsOfTheTreeAndOfPrograms)
{
  EXPECT_TRUE(added);
  std::vector<std::string> models;
  for (const CameraRow& row : cameraRows())
  {
    models.push_back(row.model);
    EXPECT_FALSE(row.description.empty());
    EXPECT_EQ(findCamera(row.model), row.entry);
  }
  EXPECT_THAT(models, testing::IsSupersetOf({ "pinhole", "orthographic", "fisheye", "strange" }));
  EXPECT_EQ(findCamera("no such model"), nullptr);
  EXPECT_FALSE(addCamera({ "pinhole", "another", &strange })) << "a second one of a name";
  EXPECT_EQ(cameraRows().size(), models.size());
}

TEST(CameraRegistry, UsualValuesFillIn)
{
  const auto camera = makeCamera("strange", whole());
  const CameraParameters& of = camera->parameters();
  EXPECT_EQ(of.numbers.at("xi"), std::vector<double>{ 2 });
  EXPECT_EQ(of.numbers.at("distortion"), std::vector<double>(4, 0.0));
  EXPECT_EQ(of.number("fovY"), 60);
  EXPECT_EQ(of.files.at("rays"), "a.npy");
  CameraParameters withK = whole();
  withK.K = Eigen::Matrix3d::Identity();
  EXPECT_EQ(makeCamera("strange", withK)->parameters().numbers.count("fovY"), 0u) << "K says it";
}

TEST(CameraRegistry, CamerasAreMadeAgainOfTheirParameters)
{
  for (const CameraParameters& of :
    { CameraParameters{ 64, 48, std::nullopt, { { "fovY", { 50 } }, { "aspect", { 2 } } } },
      CameraParameters{ 64, 48, std::nullopt } })
  {
    const auto made = makeCamera("pinhole", of);
    EXPECT_EQ(makeCamera("pinhole", made->parameters())->linear()->K, made->linear()->K);
    EXPECT_TRUE(made->parameters().numbers.empty()) << "K says it all";
  }
  const auto parallel =
    makeCamera("orthographic", { 64, 48, std::nullopt, { { "viewHeight", { 3 } }, { "aspect", { 2 } } } });
  EXPECT_EQ(makeCamera("orthographic", parallel->parameters())->linear()->K, parallel->linear()->K);
}

TEST(CameraRegistry, CamerasOfOneLensMayRollOrNot)
{
  CameraParameters of{ 64, 48, std::nullopt, { { "fovY", { 51 } } } };
  EXPECT_FALSE(makeCamera("pinhole", of)->rolls());
  of.rollingShutter = { 0.5, RollingShutter::Direction::Left };
  EXPECT_EQ(makeCamera("pinhole", of)->times().last, 0.25);
  of.rollingShutter.duration = 1;
  EXPECT_EQ(makeCamera("pinhole", of)->times().last, 0.5);
  of.rollingShutter.duration = 0;
  EXPECT_FALSE(makeCamera("pinhole", of)->rolls());
}

TEST(CameraRegistry, RefusesWhatTheRowsDoNotSay)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
    refusalOf("no such", { 4, 3, std::nullopt }), HasSubstr("no such camera model: 'no such' (there are pinhole, "));
  EXPECT_THAT(refusalOf("pinhole", { 0, 3, std::nullopt }), HasSubstr("image size out of range"));
  EXPECT_THAT(refusalOf("pinhole", { 4, 3, std::nullopt, { { "xi", { 1 } } } }), HasSubstr("'pinhole' has no 'xi'"));
  EXPECT_THAT(refusalOf("pinhole", { 4, 3, std::nullopt, {}, { { "fovY", "a" } } }), HasSubstr("has no 'fovY'"));
  EXPECT_THAT(refusalOf("pinhole", { 4, 3, std::nullopt, { { "K", { 1 } } } }), HasSubstr("has no 'K'"));
  EXPECT_EQ(refusalOf("pinhole", { 4, 3, std::nullopt, { { "fovY", { 180 } } } }),
    "fovY out of range (expected degrees above 0 and below 180, found 180)");
  EXPECT_THAT(
    refusalOf("strange", { 4, 3, std::nullopt, {}, { { "rays", "a" } } }), HasSubstr("xi has 0 numbers (expected 1)"));
  CameraParameters of = whole();
  of.files.clear();
  EXPECT_THAT(refusalOf("strange", of), HasSubstr("needs 'rays'"));
  of = whole();
  of.numbers["distortion"] = { 1, 2 };
  EXPECT_EQ(refusalOf("strange", of), "distortion has 2 numbers (expected 1, 4 or 5)");
  for (const double wrong : { 9.0, nan })
  {
    of.numbers["distortion"] = { 1, 2, 3, wrong };
    EXPECT_THAT(refusalOf("strange", of), HasSubstr("distortion out of range (expected numbers within 9, found "));
  }
  of.numbers["distortion"] = of.numbers["xi"];
  EXPECT_EQ(refusalOf("strange", of), "xi and distortion are the same");
}
