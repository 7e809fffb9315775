// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkSceneJson.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <fstream>

namespace dgtk::test
{

namespace
{
// Every key, none with its default.
const char* const everything = R"({
  "cameras": [ { "name": "a", "eye": [0, 0, 1], "lookAt": [0, 0, 0], "sensor": {
    "color": {
      "psf": { "kernel": [0, 1, 0, 1, 2, 1, 0, 1, 0] },
      "vignetting": { "cos4": 0.5, "polynomial": [-0.1, 0.2, -0.3] },
      "texture": { "amplitude": 0.1, "period": 8, "octaves": 3, "persistence": 0.4, "multiplicative": false, "fixed": false },
      "exposure": 0.5, "fullWell": 5000, "gain": 2, "darkSignal": 3, "shotNoise": true, "prnu": 0.01, "dsnu": 4,
      "rowNoise": 5, "columnNoise": 6, "readNoise": 7, "bits": 10, "blackLevel": 0.01, "bayer": "GBRG",
      "response": "table", "gamma": 1.8, "table": [0, 0.6, 1], "salt": 0.02, "pepper": 0.03,
      "jpegQuality": 80, "jpegChroma": "4:4:4"
    },
    "depth": {
      "gaussian": [0.01, 0.02, 0.03], "kinect": { "axial": 2, "lateral": 1.5, "metres": 0.01 },
      "stereo": { "baseline": 0.1, "subpixel": 0.125, "sigma": 0.2 }, "least": 1, "most": 9,
      "dropout": { "random": 0.1, "occluded": 0.7, "edge": 0.2, "edgeJump": 0.3, "edgeRadius": 2, "grazing": 0.4, "grazingAngle": 70 }
    } } } ]
})";

SceneDescription read(const TemporaryFolder& folder, const std::string& text)
{
  std::ofstream(folder.path("a.json")) << text;
  return readScene(folder.path("a.json"));
}
} // namespace

TEST(SensorJson, EveryKeyIsReadAndWrittenBack)
{
  const TemporaryFolder folder;
  const SceneDescription scene = read(folder, everything);
  const std::string text = toJson(scene, folder.path());
  for (const auto& [name, keys] : scenefile::jsonSceneKeys())
  {
    const bool ofSensor = name == "colorSensor" || name == "depthSensor" || name == "vignetting" || name == "kinect" ||
                          name == "sensorTexture" || name == "stereo" || name == "dropout";
    for (const std::string& key : keys)
    {
      EXPECT_TRUE(!ofSensor || text.find('"' + key + '"') != std::string::npos) << name << ' ' << key;
    }
  }
  EXPECT_EQ(toJson(read(folder, text), folder.path()), text);
  const ColorSensorParameters color = scene.cameras[0].sensor->color.value();
  EXPECT_EQ(color.psf.kernel.size(), 9u);
  EXPECT_EQ(color.vignetting.polynomial[2], -0.3);
  EXPECT_EQ(color.bayer, BayerPattern::GBRG);
  EXPECT_EQ(color.response, ResponseCurve::Table);
  EXPECT_TRUE(color.jpegFullChroma);
  const DepthSensorParameters depth = scene.cameras[0].sensor->depth.value();
  EXPECT_EQ(depth.gaussian[1], 0.02);
  EXPECT_EQ(depth.dropout.edgeRadius, 2);
  EXPECT_EQ(depth.stereo.subpixel, 0.125);
}

TEST(SensorJson, APartWithoutKeysIsNotAPartThatIsMissing)
{
  const TemporaryFolder folder;
  const std::string camera = R"({ "cameras": [ { "eye": [0, 0, 1], "lookAt": [0, 0, 0])";
  const SceneDescription none = read(folder, camera + "} ] }");
  EXPECT_FALSE(none.cameras[0].sensor);
  SceneDescription scene = read(folder, camera + R"(, "sensor": { "color": {} } } ] })");
  scene = read(folder, toJson(scene, folder.path()));
  ASSERT_TRUE(scene.cameras[0].sensor);
  EXPECT_TRUE(scene.cameras[0].sensor->color);
  EXPECT_FALSE(scene.cameras[0].sensor->depth);
}

TEST(SensorJson, AScenePutTogetherByProgramObeysTheSameRules)
{
  const TemporaryFolder folder;
  SceneDescription scene = read(folder, everything);
  scene.cameras[0].sensor->color->psf.disc = 2;
  EXPECT_THROW(validate(scene), InputError);
  scene.cameras[0].sensor->color->psf.disc = 0;
  EXPECT_NO_THROW(validate(scene));
  scene.cameras[0].sensor->depth->least = -1;
  EXPECT_THROW(validate(scene), InputError);
}

TEST(SensorJson, LimitsAreWithin)
{
  struct Row
  {
    const char* part;
    const char* key; ///< with # for the value
    std::vector<const char*> good, bad;
  };
  const Row table[] = { { "color", "\"psf\": {\"gaussian\": #}", { "0", "32" }, { "-0.001", "32.001" } },
    { "color", "\"psf\": {\"disc\": #}", { "0", "32" }, { "-0.001", "32.001" } },
    { "color", "\"psf\": {\"kernel\": [1, 0, 0, 0, 0, 0, 0, 0, #]}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"vignetting\": {\"cos4\": #}", { "0", "1" }, { "-0.001", "1.001" } },
    { "color", "\"vignetting\": {\"polynomial\": [0, #, 0]}", { "-1e6", "1e6" }, { "-1000001", "1000001" } },
    { "color", "\"texture\": {\"amplitude\": #}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"texture\": {\"period\": #}", { "1e-9", "1e9" }, { "0", "1.1e9" } },
    { "color", "\"texture\": {\"octaves\": #}", { "1", "16" }, { "0", "17", "1.5" } },
    { "color", "\"texture\": {\"persistence\": #}", { "0", "1" }, { "-0.001", "1.001" } },
    { "color", "\"exposure\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"fullWell\": #", { "1e-9", "1e9" }, { "0", "1.1e9" } },
    { "color", "\"gain\": #", { "1e-9", "1e9" }, { "0", "1.1e9" } },
    { "color", "\"darkSignal\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"prnu\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"dsnu\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"rowNoise\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"columnNoise\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"readNoise\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "color", "\"bits\": #", { "0", "24" }, { "-1", "25", "8.5" } },
    { "color", "\"blackLevel\": #", { "0", "1" }, { "-0.001", "1.001" } },
    { "color", "\"gamma\": #", { "1e-9", "10" }, { "0", "10.001" } },
    { "color", "\"response\": \"table\", \"table\": [0, #]", { "0", "1" }, { "-0.001", "1.001" } },
    { "color", "\"salt\": #", { "0", "1" }, { "-0.001", "1.001" } },
    { "color", "\"pepper\": #", { "0", "1" }, { "-0.001", "1.001" } },
    { "color", "\"salt\": 0.25, \"pepper\": #", { "0.75" }, { "0.751" } },
    { "color", "\"jpegQuality\": #", { "0", "100" }, { "-1", "101", "50.5" } },
    { "depth", "\"gaussian\": [0, 0, #]", { "-1e6", "1e6" }, { "-1000001", "1000001" } },
    { "depth", "\"kinect\": {\"axial\": #}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "depth", "\"kinect\": {\"lateral\": #}", { "0", "3" }, { "-0.001", "3.001" } },
    { "depth", "\"kinect\": {\"metres\": #}", { "1e-9", "1e9" }, { "0", "1.1e9" } },
    { "depth", "\"stereo\": {\"baseline\": #}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "depth", "\"stereo\": {\"baseline\": 1, \"subpixel\": #}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "depth", "\"stereo\": {\"baseline\": 1, \"sigma\": #}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "depth", "\"least\": #", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "depth", "\"most\": #", { "0", "1e-9", "1e9" }, { "-1", "1.1e9" } },
    { "depth", "\"least\": 2, \"most\": #", { "0", "2.001" }, { "1", "2" } },
    { "depth", "\"dropout\": {\"random\": #}", { "0", "1" }, { "-0.001", "1.001" } },
    { "depth", "\"stereo\": {\"baseline\": 1}, \"dropout\": {\"occluded\": #}", { "0", "1" }, { "-0.001", "1.001" } },
    { "depth", "\"dropout\": {\"occluded\": #}", { "0" }, { "1" } },
    { "depth", "\"dropout\": {\"edge\": #}", { "0", "1" }, { "-0.001", "1.001" } },
    { "depth", "\"dropout\": {\"edgeJump\": #}", { "0", "1e9" }, { "-1", "1.1e9" } },
    { "depth", "\"dropout\": {\"edgeRadius\": #}", { "1", "16" }, { "0", "17", "1.5" } },
    { "depth", "\"dropout\": {\"grazing\": #}", { "0", "1" }, { "-0.001", "1.001" } },
    { "depth", "\"dropout\": {\"grazingAngle\": #}", { "0", "90" }, { "-0.001", "90.001" } } };
  const TemporaryFolder folder;
  for (const Row& row : table)
  {
    const auto isRead = [&](const char* value)
    {
      std::string key = row.key;
      key.replace(key.find('#'), 1, value);
      const std::string json = std::string(R"({ "cameras": [ { "eye": [0, 0, 1], "lookAt": [0, 0, 0], "sensor": { ")") +
                               row.part + "\": {" + key + "} } } ] }";
      return test::thrownBy<InputError>([&] { read(folder, json); }).empty();
    };
    for (const char* value : row.good)
    {
      EXPECT_TRUE(isRead(value)) << row.key << ' ' << value;
    }
    for (const char* value : row.bad)
    {
      EXPECT_FALSE(isRead(value)) << row.key << ' ' << value;
    }
  }
}

} // namespace dgtk::test
