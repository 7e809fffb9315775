// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkCompare.h"
#include "dgtkError.h"
#include "dgtkJournal.h"
#include "dgtkSceneFolders.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

namespace dgtk::app
{

namespace
{
constexpr const char* toleranceOption = "--tolerance";
constexpr double mostPixels = 9e15; // whole numbers of a double

using Tolerances = std::map<std::string, CompareTolerance>;

[[noreturn]] void badTolerance(const std::string& text, const std::string& part)
{
  throw UsageError(std::string(toleranceOption) +
                   ": expected [LAYER:]value=V,pixels=N,share=S, at least one of them, " +
                   "numbers from 0, S at most 1, found " + quoted(part.empty() ? text : part));
}

void setLimit(CompareTolerance& tolerance, const std::string& text, const std::string& part)
{
  const std::size_t equals = part.find('=');
  const std::string key = part.substr(0, equals);
  const std::string number = equals == std::string::npos ? "" : part.substr(equals + 1);
  double value = -1;
  const auto [end, code] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (code != std::errc() || end != number.data() + number.size() || !std::isfinite(value) || value < 0)
  {
    badTolerance(text, part);
  }
  if (key == "value")
  {
    tolerance.value = value;
  }
  else if (key == "pixels" && value == std::floor(value) && value <= mostPixels)
  {
    tolerance.pixels = static_cast<std::uint64_t>(value);
  }
  else if (key == "share" && value <= 1)
  {
    tolerance.share = value;
  }
  else
  {
    badTolerance(text, part);
  }
}

// Layer (or none) and limits of "color:value=2,share=0.001".
Tolerances parseTolerances(const std::vector<std::string>& texts)
{
  Tolerances tolerances;
  for (const std::string& text : texts)
  {
    const std::size_t colon = text.find(':');
    const std::string layer = colon == std::string::npos ? "" : text.substr(0, colon);
    CompareTolerance tolerance;
    std::set<std::string> given;
    for (std::size_t begin = colon == std::string::npos ? 0 : colon + 1; begin <= text.size();)
    {
      const std::size_t comma = std::min(text.find(',', begin), text.size());
      const std::string part = text.substr(begin, comma - begin);
      setLimit(tolerance, text, part);
      const std::string key = part.substr(0, part.find('='));
      if (!given.insert(key).second)
      {
        throw UsageError(std::string(toleranceOption) + ": " + key + " twice in " + quoted(text));
      }
      begin = comma + 1;
    }
    if (!tolerances.emplace(layer, tolerance).second)
    {
      throw UsageError(std::string(toleranceOption) + ": two for " + quoted(layer));
    }
  }
  return tolerances;
}

int compareFolders(const std::string& a, const std::string& b, const Tolerances& tolerances, bool json)
{
  if (tolerances.count("") > 0)
  {
    throw UsageError(std::string(toleranceOption) + ": datasets need the layer: LAYER:value=V,pixels=N,share=S");
  }
  for (const std::string& folder : { a, b })
  {
    std::error_code code;
    if (!tolerances.empty() && std::filesystem::is_directory(folder, code) &&
        !std::filesystem::exists(folder + '/' + manifestName, code) && !code)
    {
      throw UsageError(std::string(toleranceOption) + ": is for datasets, and " + folder + " has no " + manifestName);
    }
  }
  const DatasetComparison result = compareDatasets(a, b, tolerances);
  if (json)
  {
    print(compareJson(result) + '\n');
    return result.equal ? 0 : 1;
  }
  for (const CompareResult& file : result.differing)
  {
    print(describe(file) + '\n');
  }
  const auto within = std::count_if(result.differing.begin(), result.differing.end(),
    [](const CompareResult& file) { return file.tolerance && file.equal; });
  print(std::to_string(result.files) + " files, " + std::to_string(result.differing.size()) + " differ" +
        (tolerances.empty() ? "" : ", " + std::to_string(within) + " of these within tolerances") + '\n');
  return result.equal ? 0 : 1;
}

/// Two datasets, or two folders of datasets: one scene after another, by their names.
int compareScenes(const std::string& a, const std::string& b, const Tolerances& tolerances, bool json)
{
  const std::vector<std::string> scenes = sceneFoldersIn(a);
  if (scenes.empty() && sceneFoldersIn(b).empty())
  {
    return compareFolders(a, b, tolerances, json);
  }
  if (scenes != sceneFoldersIn(b))
  {
    print(json ? "{ \"equal\": false }\n" : a + " and " + b + ": the scenes differ\n");
    return 1;
  }
  if (json)
  {
    throw UsageError("many scenes are compared in words only; compare two of them as JSON");
  }
  int differ = 0;
  for (const std::string& scene : scenes)
  {
    print(scene + ":\n");
    differ |= compareFolders(a + '/' + scene, b + '/' + scene, tolerances, false);
  }
  return differ;
}

int runCompare(const Arguments& arguments)
{
  const std::string& a = arguments.positional()[0];
  const std::string& b = arguments.positional()[1];
  const bool json = arguments.has("--json");
  const Tolerances tolerances = parseTolerances(arguments.all(toleranceOption));
  std::error_code code;
  for (const std::string* path : { &a, &b })
  {
    if (!std::filesystem::exists(*path, code))
    {
      throw InputError(*path, "does not exist");
    }
  }
  const bool folders = std::filesystem::is_directory(a, code);
  if (folders != std::filesystem::is_directory(b, code))
  {
    throw UsageError("compare needs two images or two datasets, not one of each");
  }
  if (folders)
  {
    return compareScenes(a, b, tolerances, json);
  }
  if (tolerances.size() > tolerances.count(""))
  {
    throw UsageError(std::string(toleranceOption) + ": two files have no layers (expected value=V,pixels=N,share=S)");
  }
  const CompareResult result = compareFiles(a, b, tolerances.empty() ? std::nullopt : std::optional(tolerances.at("")));
  print((json ? compareJson(result) : describe(result)) + '\n');
  return result.equal ? 0 : 1;
}
} // namespace

Command compareCommand()
{
  return { "A B", 2, 2,
    { { toleranceOption, "LAYER:value=V,pixels=N,share=S", "",
        "pixels of the layer may differ by V, and N of them, or a share S of all, by more; may be repeated" },
      { "--json", "", "", "print one JSON object" } },
    &runCompare };
}

} // namespace dgtk::app
