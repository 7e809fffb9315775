// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkCompare.h"
#include "dgtkError.h"

#include <filesystem>

namespace dgtk::app
{

namespace
{
int compareFolders(const std::string& a, const std::string& b, bool json)
{
  const DatasetComparison result = compareDatasets(a, b);
  if (json)
  {
    print(compareJson(result) + '\n');
    return result.equal ? 0 : 1;
  }
  for (const CompareResult& file : result.differing)
  {
    print(describe(file) + '\n');
  }
  print(std::to_string(result.files) + " files, " + std::to_string(result.differing.size()) + " differ\n");
  return result.equal ? 0 : 1;
}

int run(const Arguments& arguments)
{
  const std::string& a = arguments.positional()[0];
  const std::string& b = arguments.positional()[1];
  const bool json = arguments.has("--json");
  const bool folderA = std::filesystem::is_directory(a);
  const bool folderB = std::filesystem::is_directory(b);
  if (folderA != folderB)
  {
    throw UsageError("compare needs two images or two datasets, not one of each");
  }
  if (folderA)
  {
    return compareFolders(a, b, json);
  }
  const CompareResult result = compareFiles(a, b);
  print((json ? compareJson(result) : describe(result)) + '\n');
  return result.equal ? 0 : 1;
}
} // namespace

Command compareCommand()
{
  return { "compare", "A B", 2, 2, "Compares two images or two datasets; exits with 1 if they differ.",
    { { "--json", "", "", "print one JSON object" } }, &run };
}

} // namespace dgtk::app
