// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSensorParameters_h
#define dgtkSensorParameters_h

#include <array>
#include <optional>
#include <vector>

namespace dgtk
{

// What a camera's sensor does to a picture and to its depth: plain values, as in the `sensor` part of a scene's camera.
// Documentation/Formats/sensor.md gives the formulas. The default of each value leaves its effect out.

enum class BayerPattern
{
  None, ///< three sensors, one a colour
  RGGB, ///< the two rows of the cell at the image's top-left corner, one behind the other
  BGGR,
  GRBG,
  GBRG
};

enum class ResponseCurve
{
  Srgb,
  Linear,
  Gamma,
  Table
};

/// Spread of a point of light, in pixels; at most one is given. Of sum 1.
struct PointSpreadParameters
{
  double gaussian = 0;        ///< standard deviation
  double disc = 0;            ///< radius of a uniform disc, each pixel by the part of it that is covered
  std::vector<double> kernel; ///< n * n weights, n odd, rows top to bottom, applied as a convolution; >= 0, sum above 0
};

struct VignettingParameters
{
  double cos4 = 0;                                 ///< part of the light that follows cos^4 of the field angle
  std::array<double, 3> polynomial{ { 0, 0, 0 } }; ///< k1 r^2 + k2 r^4 + k3 r^6, r = 1 in the image's corner
};

/// Gradient noise (Perlin 1985, 2002) on the light.
struct TextureParameters
{
  double amplitude = 0;       ///< of the first octave, linear light
  double period = 16;         ///< pixels of its cell
  int octaves = 1;            ///< each of half the period
  double persistence = 0.5;   ///< amplitude of an octave as a part of that before
  bool multiplicative = true; ///< light (1 + noise); otherwise light + noise
  bool fixed = true;          ///< the same in every frame
};

struct ColorSensorParameters
{
  PointSpreadParameters psf;
  VignettingParameters vignetting;
  TextureParameters texture;
  double exposure = 1;     ///< factor on the light before the photosites
  double fullWell = 10000; ///< electrons of a photosite that is full; that of linear light 1 at exposure 1
  double gain = 1;         ///< digital full scale is fullWell / gain electrons
  double darkSignal = 0;   ///< mean thermal electrons of an exposure, Poisson with the light's
  bool shotNoise = false;
  double prnu = 0;        ///< standard deviation of the photosites' relative gain
  double dsnu = 0;        ///< electrons, standard deviation of the photosites' offset
  double rowNoise = 0;    ///< electrons, standard deviation of the rows' offset, the same in every frame
  double columnNoise = 0; ///< likewise of the columns
  double readNoise = 0;   ///< electrons, standard deviation of a reading
  int bits = 0;           ///< of the converter; 0: no quantisation
  double blackLevel = 0;  ///< part of full scale that is added before the converter and stays
  BayerPattern bayer = BayerPattern::None;
  ResponseCurve response = ResponseCurve::Srgb;
  double gamma = 2.2;          ///< of ResponseCurve::Gamma: value^(1 / gamma)
  std::vector<double> table;   ///< of ResponseCurve::Table: output at equal steps of the input from 0 to 1
  double salt = 0;             ///< probability that a pixel is 1
  double pepper = 0;           ///< probability that a pixel is 0
  int jpegQuality = 0;         ///< 1 to 100, 0: none
  bool jpegFullChroma = false; ///< chroma 4:4:4, otherwise 4:2:0
};

/// Noise of a structured-light camera, Nguyen, Izadi and Lovell 2012.
struct KinectParameters
{
  double axial = 0;   ///< factor on the paper's axial standard deviation
  double lateral = 0; ///< factor on the paper's lateral standard deviation
  double metres = 1;  ///< in a scene unit
};

/// A depth camera that triangulates.
struct StereoParameters
{
  double baseline = 0; ///< scene units, to a second viewpoint on the right; 0: none
  double subpixel = 0; ///< step of the disparity, pixels; 0: not quantised
  double sigma = 0;    ///< standard deviation of the disparity before it is quantised, pixels
};

/// Probabilities that a pixel has no value.
struct DropoutParameters
{
  double random = 0;        ///< any pixel
  double occluded = 0;      ///< the second viewpoint of a stereo sensor cannot see it
  double edge = 0;          ///< beside a jump of depth
  double edgeJump = 0.05;   ///< of the smaller depth
  int edgeRadius = 1;       ///< pixels, in the square around
  double grazing = 0;       ///< seen at more than the angle
  double grazingAngle = 75; ///< degrees between normal and ray
};

struct DepthSensorParameters
{
  std::array<double, 3> gaussian{ { 0, 0, 0 } }; ///< standard deviation a + b z + c z^2, scene units
  KinectParameters kinect;
  StereoParameters stereo;
  double least = 0; ///< depths below have no value; scene units
  double most = 0;  ///< depths above have no value; 0: no bound
  DropoutParameters dropout;
};

/// A camera's sensor; a part that is missing is that of defaultColorSensor() and defaultDepthSensor() (module Sensor).
struct SensorParameters
{
  std::optional<ColorSensorParameters> color;
  std::optional<DepthSensorParameters> depth;
};

} // namespace dgtk

#endif
