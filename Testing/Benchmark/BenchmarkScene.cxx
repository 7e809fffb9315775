// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkScene.h"

#include "dgtkFile.h"
#include "dgtkLayerWriter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dgtk::bench
{

namespace
{
constexpr double pi = 3.14159265358979323846;
constexpr int shapes = 5;

std::string line(const char* format, double a, double b, double c = 0)
{
  char text[128];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

// A sphere of `rings` x 2 rings quads with bumps.
std::string bumpySphere(int rings, int shape)
{
  const int columns = 2 * rings;
  std::string text = "mtllib m.mtl\nusemtl m\n";
  for (int i = 0; i <= rings; ++i)
  {
    for (int j = 0; j <= columns; ++j)
    {
      const double v = double(i) / rings;
      const double u = double(j) / columns;
      const double r = 1 + 0.08 * std::sin((3 + shape) * 2 * pi * u) * std::sin(4 * pi * v);
      const double s = r * std::sin(pi * v);
      text += line("v %.6f %.6f %.6f\n", s * std::cos(2 * pi * u), r * std::cos(pi * v), -s * std::sin(2 * pi * u));
      text += line("vt %.6f %.6f\n", 3 * u, 2 * v);
    }
  }
  for (int i = 0; i < rings; ++i)
  {
    for (int j = 0; j < columns; ++j)
    {
      const int a = i * (columns + 1) + j + 1;
      const int b = a + columns + 1;
      char quad[96];
      std::snprintf(quad, sizeof quad, "f %d/%d %d/%d %d/%d %d/%d\n", a, a, b, b, b + 1, b + 1, a + 1, a + 1);
      text += quad;
    }
  }
  return text;
}

void writeTexture(const std::string& path)
{
  constexpr int size = 256;
  LayerSpec spec;
  spec.name = "color";
  spec.channels = 3;
  Rows rows(PixelType::UInt8, 3, size, 0, size);
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const bool checker = ((x / 32) + (y / 32)) % 2 != 0;
      std::uint8_t* p = rows.row<std::uint8_t>(y) + 3 * x;
      p[0] = static_cast<std::uint8_t>(checker ? 220 : x);
      p[1] = static_cast<std::uint8_t>(checker ? 200 : y);
      p[2] = static_cast<std::uint8_t>(checker ? 160 : 255 - x);
    }
  }
  const auto writer = makeLayerWriter("png", path, spec, size, size);
  writer->write(rows);
  writer->finish();
}

// Keys of a camera that turns around the objects, `right` units along its own x axis.
std::string camera(const char* name, int frames, double right, bool distorted)
{
  std::string eye;
  std::string lookAt;
  for (int f = 0; f < frames; ++f)
  {
    const double c = std::cos(0.05 * f);
    const double s = std::sin(0.05 * f);
    const std::string key = std::string(f ? ", " : "") + "[" + std::to_string(f) + ", [";
    eye += key + line("%.17g, %.17g, %.17g]]", 17 * c + right * s, 7, 17 * s - right * c);
    lookAt += key + line("%.17g, %.17g, %.17g]]", right * s, 0.5, -right * c);
  }
  return std::string("{\"name\": \"") + name + "\", " +
         (distorted ? "\"distortion\": [-0.2, 0.05, 0.002, -0.001], " : "") +
         "\"fovY\": 50, \"near\": 0.5, \"far\": 100, \"up\": [0, 1, 0], \"eye\": {\"keys\": [" + eye +
         "]}, \"lookAt\": {\"keys\": [" + lookAt + "]}}";
}
} // namespace

std::string writeBenchmarkScene(const std::string& folder, const SceneOptions& options)
{
  makeFolders(folder);
  writeTexture(folder + "/t.png");
  writeFile(folder + "/m.mtl", "newmtl m\nKa 0.2 0.2 0.2\nKd 0.9 0.9 0.9\nKs 0.3 0.3 0.3\nNs 20\nmap_Kd t.png\n");
  const double perObject = double(options.triangles) / options.objects;
  const int rings = std::max(2, static_cast<int>(std::lround(std::sqrt(perObject / 4))));
  for (int shape = 0; shape < shapes; ++shape)
  {
    writeFile(folder + "/s" + std::to_string(shape) + ".obj", bumpySphere(rings, shape));
  }
  std::string scene = "{\n\"objects\": [\n";
  for (int i = 0; i < options.objects; ++i)
  {
    const double angle = 2.39996 * i; // golden angle: an even spread
    const double radius = 1.6 * std::sqrt(i + 0.5);
    scene += std::string(i ? ",\n" : "") + "{\"name\": \"o" + std::to_string(i) + "\", \"model\": \"s" +
             std::to_string(i % shapes) + ".obj\", \"position\": [" +
             line("%.4f, %.4f, %.4f", radius * std::cos(angle), 0.3 * (i % 7), radius * std::sin(angle)) + "]}";
  }
  scene += "\n],\n\"lights\": [{\"kind\": \"point\", \"position\": [20, 30, 20]" +
           std::string(options.shadows ? ", \"shadows\": true" : "") + "}],\n\"cameras\": [";
  scene += camera("c", options.frames, 0, options.distorted) +
           (options.stereo ? ",\n" + camera("r", options.frames, 0.3, options.distorted) : "");
  writeFile(folder + "/scene.json", scene + "]\n}\n");
  return folder + "/scene.json";
}

} // namespace dgtk::bench
