// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneJsonRows.h"
#include "dgtkSensorDescription.h"

namespace dgtk::scenefile
{

namespace
{
using Sensor = SensorParameters;
using Color = ColorSensorParameters;
using Depth = DepthSensorParameters;
using Spread = PointSpreadParameters;
using Vignetting = VignettingParameters;
using Texture = TextureParameters;
using Kinect = KinectParameters;
using Stereo = StereoParameters;
using Dropout = DropoutParameters;

constexpr Range pixels{ 0, 32, false, false, "a number from 0 to 32" };
constexpr Range weight{ 0, 1e9, false, false, "a number from 0 to 1e9" };
constexpr Range coefficient{ -1e6, 1e6, false, false, "a number from -1e6 to 1e6" };
constexpr Range amount{ 0, 1e9, false, false, "a number from 0 to 1e9" };
constexpr Range positive{ 0, 1e9, true, false, "a number above 0, up to 1e9" };
constexpr Range octaves{ 1, 16, false, false, "a whole number from 1 to 16" };
constexpr Range bits{ 0, 24, false, false, "a whole number from 0 to 24" };
constexpr Range gamma{ 0, 10, true, false, "a number above 0, up to 10" };
constexpr Range quality{ 0, 100, false, false, "a whole number from 0 to 100" };
constexpr Range factor{ 0, 3, false, false, "a number from 0 to 3" };
constexpr Range squareRadius{ 1, 16, false, false, "a whole number from 1 to 16" };
constexpr Range angle{ 0, 90, false, false, "degrees from 0 to 90" };

const std::vector<std::string>& bayerWords()
{
  static const std::vector<std::string> words{ "none", "RGGB", "BGGR", "GRBG", "GBRG" };
  return words;
}
const std::vector<std::string>& responseWords()
{
  static const std::vector<std::string> words{ "srgb", "linear", "gamma", "table" };
  return words;
}
const std::vector<std::string>& chromaWords()
{
  static const std::vector<std::string> words{ "4:2:0", "4:4:4" };
  return words;
}

const std::vector<JsonField<Spread>>& spreadFields()
{
  static const std::vector<JsonField<Spread>> fields{
    row<&Spread::gaussian, pixels>("gaussian"),
    row<&Spread::disc, pixels>("disc"),
    row<&Spread::kernel, weight>("kernel"),
  };
  return fields;
}

const std::vector<JsonField<Vignetting>>& vignettingFields()
{
  static const std::vector<JsonField<Vignetting>> fields{
    row<&Vignetting::cos4, rules::unit>("cos4"),
    row<&Vignetting::polynomial, coefficient>("polynomial"),
  };
  return fields;
}

const std::vector<JsonField<Texture>>& textureFields()
{
  static const std::vector<JsonField<Texture>> fields{
    row<&Texture::amplitude, amount>("amplitude"),
    row<&Texture::period, positive>("period"),
    row<&Texture::octaves, octaves>("octaves"),
    row<&Texture::persistence, rules::unit>("persistence"),
    row<&Texture::multiplicative>("multiplicative"),
    row<&Texture::fixed>("fixed"),
  };
  return fields;
}

const std::vector<JsonField<Color>>& colorFields()
{
  static const std::vector<JsonField<Color>> fields{
    structRow<&Color::psf, spreadFields>("psf"),
    structRow<&Color::vignetting, vignettingFields>("vignetting"),
    structRow<&Color::texture, textureFields>("texture"),
    row<&Color::exposure, amount>("exposure"),
    row<&Color::fullWell, positive>("fullWell"),
    row<&Color::gain, positive>("gain"),
    row<&Color::darkSignal, amount>("darkSignal"),
    row<&Color::shotNoise>("shotNoise"),
    row<&Color::prnu, amount>("prnu"),
    row<&Color::dsnu, amount>("dsnu"),
    row<&Color::rowNoise, amount>("rowNoise"),
    row<&Color::columnNoise, amount>("columnNoise"),
    row<&Color::readNoise, amount>("readNoise"),
    row<&Color::bits, bits>("bits"),
    row<&Color::blackLevel, rules::unit>("blackLevel"),
    wordRow<&Color::bayer, bayerWords>("bayer"),
    wordRow<&Color::response, responseWords>("response"),
    row<&Color::gamma, gamma>("gamma"),
    row<&Color::table, rules::unit>("table"),
    row<&Color::salt, rules::unit>("salt"),
    row<&Color::pepper, rules::unit>("pepper"),
    row<&Color::jpegQuality, quality>("jpegQuality"),
    wordRow<&Color::jpegFullChroma, chromaWords>("jpegChroma"),
  };
  return fields;
}

const std::vector<JsonField<Kinect>>& kinectFields()
{
  static const std::vector<JsonField<Kinect>> fields{
    row<&Kinect::axial, amount>("axial"),
    row<&Kinect::lateral, factor>("lateral"),
    row<&Kinect::metres, positive>("metres"),
  };
  return fields;
}

const std::vector<JsonField<Stereo>>& stereoFields()
{
  static const std::vector<JsonField<Stereo>> fields{
    row<&Stereo::baseline, amount>("baseline"),
    row<&Stereo::subpixel, amount>("subpixel"),
    row<&Stereo::sigma, amount>("sigma"),
  };
  return fields;
}

const std::vector<JsonField<Dropout>>& dropoutFields()
{
  static const std::vector<JsonField<Dropout>> fields{
    row<&Dropout::random, rules::unit>("random"),
    row<&Dropout::occluded, rules::unit>("occluded"),
    row<&Dropout::edge, rules::unit>("edge"),
    row<&Dropout::edgeJump, amount>("edgeJump"),
    row<&Dropout::edgeRadius, squareRadius>("edgeRadius"),
    row<&Dropout::grazing, rules::unit>("grazing"),
    row<&Dropout::grazingAngle, angle>("grazingAngle"),
  };
  return fields;
}

const std::vector<JsonField<Depth>>& depthFields()
{
  static const std::vector<JsonField<Depth>> fields{
    row<&Depth::gaussian, coefficient>("gaussian"),
    structRow<&Depth::kinect, kinectFields>("kinect"),
    structRow<&Depth::stereo, stereoFields>("stereo"),
    row<&Depth::least, amount>("least"),
    row<&Depth::most, amount>("most"),
    structRow<&Depth::dropout, dropoutFields>("dropout"),
  };
  return fields;
}

/// A part that may be missing; one with nothing but defaults is written as {}.
template <auto Member, auto Fields>
JsonField<Sensor> partRow(const char* key)
{
  return { key,
    [](const JsonCursor& at, Sensor& into)
    {
      auto& part = (into.*Member).emplace();
      readFields(at, Fields(), part);
      const std::string fault = faultOf(part);
      if (!fault.empty())
      {
        at.fail("cannot be used", fault);
      }
    },
    [](const Sensor& from, const char* name, JsonNode& object)
    {
      if (from.*Member)
      {
        object.add(name, writeFields(*(from.*Member), Fields()));
      }
    } };
}

const std::vector<JsonField<Sensor>>& sensorFields()
{
  static const std::vector<JsonField<Sensor>> fields{
    partRow<&Sensor::color, colorFields>("color"),
    partRow<&Sensor::depth, depthFields>("depth"),
  };
  return fields;
}
} // namespace

JsonField<CameraDescription> sensorRow()
{
  return { "sensor",
    [](const JsonCursor& at, CameraDescription& into) { readFields(at, sensorFields(), into.sensor.emplace()); },
    [](const CameraDescription& from, const char* name, JsonNode& object)
    {
      if (from.sensor)
      {
        object.add(name, writeFields(*from.sensor, sensorFields()));
      }
    } };
}

std::map<std::string, std::vector<std::string>> sensorKeys()
{
  return { { "sensor", keysOf(sensorFields()) }, { "colorSensor", keysOf(colorFields()) },
    { "psf", keysOf(spreadFields()) }, { "vignetting", keysOf(vignettingFields()) },
    { "sensorTexture", keysOf(textureFields()) }, { "depthSensor", keysOf(depthFields()) },
    { "kinect", keysOf(kinectFields()) }, { "stereo", keysOf(stereoFields()) },
    { "dropout", keysOf(dropoutFields()) } };
}

} // namespace dgtk::scenefile
