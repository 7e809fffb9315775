// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTestSupport.h"

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <stdlib.h>

namespace dgtk::test
{

TemporaryFolder::TemporaryFolder()
{
  constexpr std::size_t random = 6; // characters that mkdtemp replaces
  std::string pattern = (std::filesystem::temp_directory_path() / "dgtk-test-").string() + std::string(random, 'X');
  if (!::mkdtemp(pattern.data()))
  {
    throw std::runtime_error("no temporary folder: " + pattern);
  }
  this->Path = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(this->Path, ignored);
}

std::string sourceFile(const std::string& relative) { return std::string(DGTK_SOURCE_DIR) + '/' + relative; }

std::string extraModels()
{
  const char* set = std::getenv("DGTK_EXTRA_MODELS");
  return set ? set : DGTK_EXTRA_MODELS_DEFAULT;
}

std::string contentsOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    throw std::runtime_error("cannot be read: " + path);
  }
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

} // namespace dgtk::test
