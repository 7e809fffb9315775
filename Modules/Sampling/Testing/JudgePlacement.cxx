// SPDX-License-Identifier: BSD-3-Clause
// Drops twenty things into the bin and onto the table, SAMPLES times each, and prints what came of it, one line a
// sample and a summary: JudgePlacement [SAMPLES [FIRST]].
#include "dgtkPlaceSamples.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

namespace
{
using namespace dgtk;

void judge(const char* support, const char* rule, int first, int samples)
{
  std::vector<double> penetrations;
  std::vector<double> gaps;
  std::vector<double> seconds;
  std::map<std::string, int> reasons;
  for (int sample = first; sample < first + samples; ++sample)
  {
    PlaceScene made = twentyThings(support, rule, std::uint64_t(sample));
    const std::clock_t start = std::clock();
    const std::vector<PlaceOutcome> placed = made.place(std::uint64_t(sample));
    seconds.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
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
    std::printf("%-12s median %.4f, 90 %% %.4f, 99 %% %.4f, most %.4f\n", name, at(0.5), at(0.9), at(0.99), at(1));
  };
  std::printf("%s: %zu of %d kept\n", support, gaps.size(), 20 * samples);
  if (!gaps.empty())
  {
    summary("in, mm", penetrations, 1000);
    summary("hovers, mm", gaps, 1000);
  }
  summary("seconds", seconds, 1);
  for (const auto& reason : reasons)
  {
    std::printf("%4d: %s\n", reason.second, reason.first.c_str());
  }
}
} // namespace

int main(int argc, char** argv)
{
  const int samples = argc > 1 ? std::atoi(argv[1]) : 5;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  judge("bin.ac", R"({ "in": "support", "drop": { "height": 0.05 } })", first, samples);
  judge("table.ac", R"({ "on": "support", "region": [[-0.5, -0.3], [0.5, 0.3]], "drop": { "height": 0.05 } })", first,
    samples);
  return 0;
}
