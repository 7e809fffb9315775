// SPDX-License-Identifier: BSD-3-Clause
// What the visible cells of somebody's VTK scene cost beside the bare rays of the same engine.
//
//   BenchmarkVTKScene [--resolution N] [--size WxH] [--rounds N]
//
// The scene is a sphere of about N * N triangles (1000: a million). Processor time in milliseconds, the median over the
// rounds, all in one process:
//
//   tree         building the tree that rays go through, and the bare rays after it
//   first call   taking the view and counting the pixels of each cell, with nothing known before
//   bare rays    packets of 16 in single precision, nothing but ids recorded
//   second call  the same as the first call, of a renderer that did not change
//   after a turn the same, the camera turned
#include "Measure.h"

#include "dgtkRaySource.h"
#include "dgtkSnapshot.h"
#include "dgtkStage.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;

struct Settings
{
  int resolution = 1000;
  int width = 640;
  int height = 480;
  int rounds = 9;
};

double processorTime(const std::function<void()>& work)
{
  const std::clock_t start = std::clock();
  work();
  return 1000.0 * double(std::clock() - start) / CLOCKS_PER_SEC;
}

double medianOf(int rounds, const std::function<double()>& once)
{
  std::vector<double> all;
  all.reserve(std::size_t(rounds));
  for (int i = 0; i < rounds; ++i)
  {
    all.push_back(once());
  }
  return bench::median(all);
}

/// Counts the pixels of all cells; ends the program where that fails.
void countCells(vtkRenderer& renderer, const Settings& settings)
{
  vtkNew<dgtkSnapshot> shot;
  if (!shot->Take(&renderer, settings.width, settings.height) || !shot->CountCells() || shot->CountPixels(0) == nullptr)
  {
    std::fprintf(stderr, "%s\n", shot->GetErrorMessage().c_str());
    std::exit(1);
  }
}

/// Bare rays through a stage; `kept`: the engine, of which the first call builds the tree.
double bareRays(const Stage& stage, ThreadPool& pool, std::unique_ptr<VisibilitySource>& kept)
{
  return processorTime(
    [&]
    {
      if (!kept)
      {
        kept = makeBareRaySource(pool);
      }
      const View view = stage.view(0, 0);
      VisibilityBuffer hits;
      kept->setScene(stage.at(0), view);
      kept->render({ 0, 0, view.model->width(), view.model->height() }, hits);
    });
}

bool parse(int argc, char** argv, Settings& to)
{
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i];
    const bool size = name == "--size";
    int* const number = name == "--resolution" ? &to.resolution : name == "--rounds" ? &to.rounds : nullptr;
    if (size ? std::sscanf(argv[i + 1], "%dx%d", &to.width, &to.height) != 2
             : number == nullptr || std::sscanf(argv[i + 1], "%d", number) != 1)
    {
      return false;
    }
  }
  return argc % 2 == 1 && to.resolution >= 6 && to.rounds > 0 && to.width > 0 && to.height > 0;
}

void print(const char* name, double milliseconds, double reference)
{
  std::printf("%-14s %8.1f ms %6.2f\n", name, milliseconds, milliseconds / reference);
}
} // namespace

int main(int argc, char** argv)
{
  Settings settings;
  if (!parse(argc, argv, settings))
  {
    std::fprintf(stderr, "BenchmarkVTKScene [--resolution N] [--size WxH] [--rounds N]\n");
    return 2;
  }
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(settings.resolution);
  sphere->SetPhiResolution(settings.resolution / 2 + 1);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  mapper->Update();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);

  const double first = processorTime([&] { countCells(*renderer, settings); });
  vtkNew<dgtkSnapshot> shot;
  shot->Take(renderer, settings.width, settings.height);
  ThreadPool pool(machineThreads());
  std::unique_ptr<VisibilitySource> engine;
  const double tree = bareRays(*shot->GetStage(), pool, engine);
  const double bare = medianOf(settings.rounds, [&] { return bareRays(*shot->GetStage(), pool, engine); });
  const double again =
    medianOf(settings.rounds, [&] { return processorTime([&] { countCells(*renderer, settings); }); });
  const double turned = medianOf(settings.rounds,
    [&]
    {
      renderer->GetActiveCamera()->Azimuth(3);
      return processorTime([&] { countCells(*renderer, settings); });
    });
  std::printf("%lld cells, %d x %d\n", static_cast<long long>(sphere->GetOutput()->GetNumberOfCells()), settings.width,
    settings.height);
  print("tree", tree, tree);
  print("first call", first, tree);
  print("bare rays", bare, bare);
  print("second call", again, bare);
  print("after a turn", turned, bare);
  return 0;
}
