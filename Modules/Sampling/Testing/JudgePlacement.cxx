// SPDX-License-Identifier: BSD-3-Clause
// Drops twenty things into the bin and onto the table, SAMPLES times each, and prints what came of it, one line a
// sample and a summary: JudgePlacement [SAMPLES [FIRST]]. With DGTK_EXTRA_MODELS, models of that folder fall, too.
#include "dgtkPlaceSamples.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

namespace
{
using namespace dgtk;

/// Models of the folder of further models that have a shape to fall with.
std::vector<std::string> furtherModels()
{
  std::vector<std::string> paths;
  const std::string folder = test::extraModels();
  for (const char* name : { "torcs/wheel0_acc/wheel0.acc", "opencity/containers/containers.ac",
         "torcs/needle/needle.ac", "opencity/line_n_e/line_n_e.ac", "flightgear/sailboat/sailboat.ac",
         "flightgear/red-barn2/red-barn2.ac", "flightgear/tower-hexa/tower-hexa.ac",
         "flightgear/HighriseRed/HighriseRed.ac", "assimp/SphereWithLight_UTF8BOM/SphereWithLight_UTF8BOM.ac" })
  {
    if (!folder.empty())
    {
      paths.push_back(folder + "/ac3d/" + name);
    }
  }
  return paths;
}

void judge(const char* support, const char* rule, int first, int samples)
{
  std::vector<double> penetrations;
  std::vector<double> gaps;
  std::vector<double> seconds;
  std::map<std::string, int> reasons;
  double sum = 0;
  for (int sample = first; sample < first + samples; ++sample)
  {
    PlaceScene made = twentyThings(support, rule, std::uint64_t(sample), furtherModels());
    const std::clock_t start = std::clock();
    const std::vector<PlaceOutcome> placed = made.place(std::uint64_t(sample));
    seconds.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
    sum += seconds.back();
    std::string left;
    for (const PlaceOutcome& one : placed)
    {
      if (one.note.kept)
      {
        penetrations.push_back(measured(one, "penetration"));
        gaps.push_back(measured(one, "gap"));
      }
      else
      {
        reasons[one.note.why]++;
        left += "; " + made.scene.objects[one.index].name + " " +
                std::string(made.scene.objects[one.index].model, made.scene.objects[one.index].model.rfind('/') + 1) +
                " " + one.note.why;
      }
    }
    std::printf("%s %d: %.2f s%s\n", support, sample, seconds.back(), left.c_str());
    std::fflush(stdout);
  }
  const auto summary = [](const char* name, std::vector<double>& of, double unit)
  {
    std::sort(of.begin(), of.end());
    const auto at = [&](double part) { return of[std::size_t(part * double(of.size() - 1))] * unit; };
    std::printf("%-12s least %.4f, median %.4f, 95 %% %.4f, 99 %% %.4f, most %.4f\n", name, at(0), at(0.5), at(0.95),
      at(0.99), at(1));
  };
  std::printf("%s: %zu of %d kept\n", support, gaps.size(), 20 * samples);
  if (!gaps.empty())
  {
    summary("in, mm", penetrations, 1000);
    summary("hovers, mm", gaps, 1000);
  }
  summary("seconds", seconds, 1);
  std::printf("%-12s %.4f\n", "mean", sum / samples);
  for (const auto& reason : reasons)
  {
    std::printf("%4d: %s\n", reason.second, reason.first.c_str());
  }
}
} // namespace

int main(int argc, char** argv)
{
  const int samples = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  judge("bin.ac", R"({ "in": "support", "drop": { "height": 0.05 } })", first, samples);
  judge("table.ac", R"({ "on": "support", "region": [[-0.5, -0.3], [0.5, 0.3]], "drop": { "height": 0.05 } })", first,
    samples);
  return 0;
}
