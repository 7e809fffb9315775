// SPDX-License-Identifier: BSD-3-Clause
// What each layer costs, and whether all layers together stay within ten times the picture alone.
//
//   BenchmarkLayers [--triangles N] [--size WxH] [--frames N] [--threads N] [--rounds N] [--large]
//                   [--only layers|all|pixels]
//
// Times are per frame of one camera, in milliseconds, everything on disk, without loading: (time of N frames - time of
// one) / (N - 1), each the median over the rounds; every run is a process of its own. The second part says how the
// cost of a pixel depends on the size of the image; --large adds 8192 x 8192, which wants some 10 GiB of disk and is
// timed by a single frame, loading included. --only all compares all layers with color and leaves out the rest.
#include "BenchmarkScene.h"
#include "Measure.h"

#include "dgtkGenerator.h"
#include "dgtkSystem.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace
{
using namespace dgtk;

struct Size
{
  int width = 640;
  int height = 480;
};

struct Settings
{
  bench::SceneOptions scene;
  Size size;
  std::vector<Size> pixels = { { 640, 480 }, { 2048, 2048 } };
  int frames = 6;
  int threads = 2;
  int rounds = 3;
  std::string only; // "layers", "all", "pixels"; layers and pixels when empty
  std::string folder;
  std::string scenePath;
};

struct Row
{
  std::string name;
  std::vector<std::string> layers;
  int samples = 1;
};

std::vector<std::string> layerNames()
{
  std::vector<std::string> names;
  for (const LayerInfo& info : generatorLayers())
  {
    if (info.layer != "color_sharp") // of cameras with a shutter or a lens only
    {
      names.push_back(info.layer);
    }
  }
  return names;
}

std::vector<Row> layerRows()
{
  std::vector<Row> rows;
  for (const std::string& layer : layerNames())
  {
    rows.push_back({ layer, { layer }, 1 });
  }
  rows.push_back({ "alpha, coverage; 1 sample a pixel", { "alpha", "coverage" }, 1 });
  rows.push_back({ "alpha, coverage; 4 x 4 samples", { "alpha", "coverage" }, 4 });
  rows.push_back({ "all layers", layerNames(), 1 });
  return rows;
}

std::vector<Row> pixelRows()
{
  return { { "depth", { "depth" }, 1 }, { "objects", { "objects" }, 1 }, { "normal", { "normal" }, 1 },
    { "edges", { "edges" }, 1 }, { "flow_forward", { "flow_forward" }, 1 },
    { "alpha, coverage", { "alpha", "coverage" }, 1 }, { "ldi", { "ldi" }, 1 } };
}

// Frame 0 is not rendered, nor is the scene's last: what is rendered has a frame before and one after.
double render(const Settings& s, const Row& row, Size size, int frames)
{
  GeneratorRequest request;
  request.scene = s.scenePath;
  request.folder = s.folder + "/out";
  request.layers = row.layers;
  request.options["samples"] = std::to_string(row.samples);
  request.cameras = { "c" };
  request.options["pairs"] = "c:r";
  request.options["matte"] = "o0";
  request.frames = FrameRange{ 1, frames, 1 };
  request.width = size.width;
  request.height = size.height;
  request.options["threads"] = std::to_string(s.threads);
  const bench::Clock::time_point start = bench::Clock::now();
  generate(request);
  const double time = bench::milliseconds(start);
  std::filesystem::remove_all(request.folder);
  return time;
}

// The first run warms the machine's caches and is not counted.
bench::Measured perFrame(const Settings& s, const Row& row, Size size, int frames)
{
  return bench::inChild(row.name,
    [&]
    {
      prepareHeap(); // as `dgtk` does
      render(s, row, { 64, 64 }, 1);
      const double one = render(s, row, size, 1);
      if (frames == 1)
      {
        return one;
      }
      return std::max(0.0, (render(s, row, size, frames) - one) / (frames - 1));
    });
}

struct Result
{
  double milliseconds = 0; // median; negative when a run failed
  double least = 0;
  double most = 0;
  double mebibytes = 0;
};

// Every row once a round, one after another.
std::vector<Result> measure(const Settings& s, const std::vector<Row>& rows, Size size, int frames)
{
  std::vector<std::vector<double>> times(rows.size());
  std::vector<Result> results(rows.size());
  for (int round = 0; round < s.rounds; ++round)
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const bench::Measured measured = perFrame(s, rows[i], size, frames);
      times[i].push_back(measured.milliseconds);
      results[i].mebibytes = std::max(results[i].mebibytes, measured.mebibytes);
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const auto [least, most] = std::minmax_element(times[i].begin(), times[i].end());
    results[i].least = *least;
    results[i].most = *most;
    results[i].milliseconds = *least < 0 ? -1 : bench::median(times[i]);
  }
  return results;
}

bool printLayers(const Settings& s)
{
  std::vector<Row> rows = layerRows();
  if (s.only == "all")
  {
    rows.erase(rows.begin() + 1, rows.end() - 1);
  }
  const std::vector<Result> results = measure(s, rows, s.size, s.frames);
  const double color = results.front().milliseconds;
  bool whole = true;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const Result& r = results[i];
    whole = whole && r.milliseconds >= 0;
    std::printf("  %-36s %8.1f ms (%.1f to %.1f) %7.0f MiB %6.2f x color\n", rows[i].name.c_str(), r.milliseconds,
      r.least, r.most, r.mebibytes, r.milliseconds / color);
  }
  std::printf("  all layers against color  %.2f  (aim: at most 10)\n", results.back().milliseconds / color);
  return whole;
}

bool printPixels(const Settings& s)
{
  const std::vector<Row> rows = pixelRows();
  bool whole = true;
  for (const Size size : s.pixels)
  {
    const double pixels = double(size.width) * size.height;
    const std::vector<Result> results = measure(s, rows, size, pixels > 1e7 ? 1 : s.frames);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const Result& r = results[i];
      whole = whole && r.milliseconds >= 0;
      std::printf("  %5d x %-5d %-20s %8.1f ns a pixel (%.1f to %.1f) %7.0f MiB\n", size.width, size.height,
        rows[i].name.c_str(), r.milliseconds * 1e6 / pixels, r.least * 1e6 / pixels, r.most * 1e6 / pixels,
        r.mebibytes);
    }
    std::fflush(stdout);
  }
  return whole;
}

Size sizeOf(const std::string& text) { return { std::stoi(text), std::stoi(text.substr(text.find('x') + 1)) }; }

Settings parse(int argc, char** argv)
{
  Settings settings;
  for (int i = 1; i < argc; ++i)
  {
    const std::string key = argv[i];
    if (key == "--large")
    {
      settings.pixels.push_back({ 8192, 8192 });
      continue;
    }
    const std::string value = i + 1 < argc ? argv[++i] : "";
    for (auto& [name, number] : std::vector<std::pair<const char*, int*>>{ { "--triangles", &settings.scene.triangles },
           { "--frames", &settings.frames }, { "--threads", &settings.threads }, { "--rounds", &settings.rounds } })
    {
      if (key == name)
      {
        *number = std::stoi(value);
      }
    }
    if (key == "--only")
    {
      settings.only = value;
    }
    if (key == "--size")
    {
      settings.size = sizeOf(value);
    }
  }
  settings.frames = std::max(2, settings.frames);
  settings.scene.frames = settings.frames + 2;
  settings.scene.stereo = true;
  return settings;
}
} // namespace

int main(int argc, char** argv)
{
  Settings settings = parse(argc, argv);
  settings.folder = (std::filesystem::temp_directory_path() / ("dgtk-layers-" + std::to_string(::getpid()))).string();
  settings.scenePath = bench::writeBenchmarkScene(settings.folder, settings.scene);
  std::printf("%d triangles in %d objects, %d x %d, %d frames, %d threads, %d rounds\n", settings.scene.triangles,
    settings.scene.objects, settings.size.width, settings.size.height, settings.frames, settings.threads,
    settings.rounds);
  std::fflush(stdout);
  const bool layers = settings.only == "pixels" || printLayers(settings);
  std::fflush(stdout);
  const bool pixels = settings.only == "layers" || settings.only == "all" || printPixels(settings);
  std::filesystem::remove_all(settings.folder);
  return layers && pixels ? 0 : 1;
}
