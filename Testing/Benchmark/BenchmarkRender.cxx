// SPDX-License-Identifier: BSD-3-Clause
// Whole-work timings as ratios against references of the same run; see Documentation/DeveloperGuide/performance.md.
//
//   BenchmarkRender [--triangles N] [--size WxH] [--frames N] [--threads N] [--rounds N] [--rows LETTERS]
//
// Each row is a process of its own (its peak memory is its own, and no two OpenGL contexts meet). Times are per frame,
// in milliseconds, without loading: (time of all frames - time of the first) / (frames - 1). All rows are run once a
// round, one after another, and each row's median over the rounds is printed: machines have moods.
#include "BenchmarkScene.h"
#include "Measure.h"
#include "StockVTK.h"

#include "dgtkFile.h"
#include "dgtkGenerator.h"
#include "dgtkLayerWriter.h"
#include "dgtkRaySource.h"
#include "dgtkStage.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <unistd.h>

namespace
{
using namespace dgtk;
using bench::Clock;
using bench::milliseconds;

struct Settings
{
  bench::SceneOptions scene;
  int width = 640;
  int height = 480;
  int threads = 2;
  int rounds = 3;
  std::string rows; ///< their letters, such as ADE; empty: all
  std::string folder;
  std::string scenePath;
  std::string shadowPath; ///< the same scene with shadows
  std::string lensPath;   ///< and with a distorting lens
};

// Calls frame(0) as warm-up, then the others; milliseconds a frame.
double timeFrames(int frames, const std::function<void(int)>& frame)
{
  frame(0);
  const Clock::time_point start = Clock::now();
  for (int f = 1; f < frames; ++f)
  {
    frame(f);
  }
  return milliseconds(start) / (frames - 1);
}

double stockColor(const Settings& s, bool everything)
{
  const auto stage = Stage::load(readScene(s.scenePath));
  bench::StockVTK stock(*stage->at(0), s.width, s.height);
  LayerSpec color;
  color.name = "color";
  color.channels = 3;
  LayerSpec depth;
  depth.name = "depth";
  depth.type = PixelType::Float64;
  LayerSpec objects;
  objects.name = "objects";
  objects.type = PixelType::UInt32;
  const std::string out = s.folder + "/stock";
  makeFolders(out);
  bench::StockVTK::Truth truth;
  const auto write = [&](
                       const char* format, const LayerSpec& spec, const std::string& name, const void* data, int frame)
  {
    Rows rows(spec.type, spec.channels, s.width, 0, s.height);
    for (int y = 0; y < s.height; ++y) // bottom to top in VTK
    {
      std::copy_n(static_cast<const std::byte*>(data) + (s.height - 1 - y) * rows.rowBytes(), rows.rowBytes(),
        rows.data() + y * rows.rowBytes());
    }
    const auto writer = makeLayerWriter(format, out + '/' + name + std::to_string(frame), spec, s.width, s.height);
    writer->write(rows);
    writer->finish();
  };
  return timeFrames(s.scene.frames,
    [&](int f)
    {
      const View view = stage->view(0, f, s.width, s.height);
      stock.render(view);
      if (everything)
      {
        stock.capture(view, truth);
        write("png", color, "color", truth.rgb.data(), f);
        write("npy", depth, "depth", truth.depth.data(), f);
        write("ppm", objects, "objects", truth.object.data(), f);
        write("npy", objects, "triangles", truth.triangle.data(), f);
      }
    });
}

// A folder that is not there yet. Those of earlier runs stay until the end: ext4 looks through all inodes that were
// freed within the last minutes when it makes a file.
std::string freshFolder(const std::string& name)
{
  int run = 0;
  while (std::filesystem::exists(name + '-' + std::to_string(run)))
  {
    ++run;
  }
  return name + '-' + std::to_string(run);
}

// Gives their place on the disk back.
void emptyFiles(const std::string& folder)
{
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      std::filesystem::resize_file(entry.path(), 0);
    }
  }
}

// `render` of the product, everything on disk. The first frame's time is measured by a run of its own.
double product(const Settings& s, const std::vector<std::string>& layers, const std::string& engine,
  const std::string& renderer = "ray", const std::string& scene = "")
{
  prepareHeap(); // as `dgtk` does
  GeneratorRequest request;
  request.scene = scene.empty() ? s.scenePath : scene;
  request.width = s.width;
  request.height = s.height;
  request.layers = layers;
  request.options["visibility"] = engine;
  request.options["renderer"] = renderer;
  request.options["threads"] = std::to_string(s.threads);
  const auto run = [&](int last)
  {
    request.folder = freshFolder(s.folder + "/out" + std::to_string(last));
    request.frames = FrameRange{ 0, last, 1 };
    ::sync();
    const Clock::time_point start = Clock::now();
    generate(request);
    const double taken = milliseconds(start);
    emptyFiles(request.folder);
    return taken;
  };
  run(0);
  const double one = run(0);
  return (run(s.scene.frames - 1) - one) / (s.scene.frames - 1);
}

double rays(const Settings& s, bool bare)
{
  const auto stage = Stage::load(readScene(s.scenePath));
  ThreadPool pool(s.threads);
  const auto source = bare ? makeBareRaySource(pool) : makeRaySource(pool);
  const TileGrid grid(s.width, s.height);
  const auto state = stage->at(0);
  VisibilityBuffer hits;
  return timeFrames(s.scene.frames,
    [&](int f)
    {
      source->setScene(state, stage->view(0, f, s.width, s.height));
      for (int row = 0; row < grid.rows(); ++row)
      {
        for (int column = 0; column < grid.columns(); ++column)
        {
          source->render(grid.tile(column, row), hits);
        }
      }
    });
}

const std::vector<std::string> truth = { "depth", "distance", "objects", "parts", "triangles", "calibration" };
const std::vector<std::string> base = { "color", "depth", "objects", "triangles", "calibration" };

struct Row
{
  const char* name;
  std::function<double(const Settings&)> run;
};

const std::vector<Row>& rows()
{
  static const std::vector<Row> all = {
    { "A  stock VTK, colour only, nothing written", [](const Settings& s) { return stockColor(s, false); } },
    { "B  stock VTK, colour + z-buffer + selector, written", [](const Settings& s) { return stockColor(s, true); } },
    { "C  dgtk by OpenGL: colour, depth, ids, calibration, written",
      [](const Settings& s) { return product(s, base, "raster", "vtk"); } },
    { "D  dgtk by rays: colour, depth, ids, calibration, written",
      [](const Settings& s) { return product(s, base, "ray"); } },
    { "E  dgtk by rays: colour only, written", [](const Settings& s) { return product(s, { "color" }, "ray"); } },
    { "F  Embree, bare primary rays in packets of 16", [](const Settings& s) { return rays(s, true); } },
    { "G  dgtk ray visibility, nothing written", [](const Settings& s) { return rays(s, false); } },
    { "H  dgtk ray: depth, distance, all ids, calibration, written",
      [](const Settings& s) { return product(s, truth, "ray"); } },
    { "I  dgtk, rays and colour by OpenGL: as C and D",
      [](const Settings& s) { return product(s, base, "ray", "vtk"); } },
    { "J  as E, with shadows of the light",
      [](const Settings& s) { return product(s, { "color" }, "ray", "ray", s.shadowPath); } },
    { "K  as E, through a lens with radial and tangential distortion",
      [](const Settings& s) { return product(s, { "color" }, "ray", "ray", s.lensPath); } },
  };
  return all;
}

Settings parse(int argc, char** argv)
{
  Settings settings;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string key = argv[i];
    const std::string value = argv[i + 1];
    if (key == "--triangles")
    {
      settings.scene.triangles = std::stoi(value);
    }
    else if (key == "--frames")
    {
      settings.scene.frames = std::stoi(value);
    }
    else if (key == "--threads")
    {
      settings.threads = std::stoi(value);
    }
    else if (key == "--rounds")
    {
      settings.rounds = std::stoi(value);
    }
    else if (key == "--rows")
    {
      settings.rows = value;
    }
    else if (key == "--size")
    {
      settings.width = std::stoi(value);
      settings.height = std::stoi(value.substr(value.find('x') + 1));
    }
  }
  return settings;
}
} // namespace

int main(int argc, char** argv)
{
  Settings settings = parse(argc, argv);
  settings.folder =
    (std::filesystem::temp_directory_path() / ("dgtk-benchmark-" + std::to_string(::getpid()))).string();
  settings.scenePath = bench::writeBenchmarkScene(settings.folder, settings.scene);
  settings.scene.shadows = true;
  settings.shadowPath = bench::writeBenchmarkScene(settings.folder + "/shadows", settings.scene);
  settings.scene.shadows = false;
  settings.scene.distorted = true;
  settings.lensPath = bench::writeBenchmarkScene(settings.folder + "/lens", settings.scene);
  std::printf("%d triangles in %d objects, %d x %d, %d frames, %d threads, %d rounds\n", settings.scene.triangles,
    settings.scene.objects, settings.width, settings.height, settings.scene.frames, settings.threads, settings.rounds);
  std::fflush(stdout);
  const auto wanted = [&](std::size_t row)
  { return settings.rows.empty() || settings.rows.find(rows()[row].name[0]) != std::string::npos; };
  std::vector<std::vector<double>> times(rows().size());
  std::vector<double> memory(rows().size(), 0.0);
  for (int round = 0; round < settings.rounds; ++round)
  {
    for (std::size_t i = 0; i < rows().size(); ++i)
    {
      if (!wanted(i))
      {
        continue;
      }
      const bench::Measured measured = bench::inChild(rows()[i].name, [&] { return rows()[i].run(settings); });
      times[i].push_back(measured.milliseconds);
      memory[i] = std::max(memory[i], measured.mebibytes);
    }
  }
  std::vector<double> median(rows().size(), std::nan("")); // so are the ratios of what was not measured
  for (std::size_t i = 0; i < rows().size(); ++i)
  {
    if (!wanted(i))
    {
      continue;
    }
    std::sort(times[i].begin(), times[i].end());
    median[i] = times[i][times[i].size() / 2];
    std::printf("  %-62s %8.1f ms (%.1f to %.1f) %7.0f MiB\n", rows()[i].name, median[i], times[i].front(),
      times[i].back(), memory[i]);
  }
  const auto ratio = [&](int a, int b) { return median[a] / median[b]; };
  std::printf("  OpenGL against bare colour      C/A %5.2f\n", ratio(2, 0));
  std::printf(
    "  rays against bare colour        D/A %5.2f  (aim at 10,000, 200,000, 2,000,000: 1.2, 0.5, 0.3)\n", ratio(3, 0));
  std::printf("  stock VTK's way against raster  B/C %5.2f  (aim: at least 3)\n", ratio(1, 2));
  std::printf("  all but colour against bare rays H/F %4.2f  (aim: at most 3)\n", ratio(7, 5));
  std::printf("  shadows against primary rays (J-E)/G %4.2f  (aim: at most 2)\n", (median[9] - median[4]) / median[6]);
  std::printf("  a distorting lens against none   K/E %4.2f  (aim: at most 1.3)\n", ratio(10, 4));
  std::filesystem::remove_all(settings.folder);
  return 0;
}
