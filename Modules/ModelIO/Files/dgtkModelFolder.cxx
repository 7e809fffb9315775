// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelFolder.h"

#include <algorithm>
#include <filesystem>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

/// Both without "." and "..".
bool begins(const fs::path& path, const fs::path& folder)
{
  auto last = folder.end();
  if (folder.has_relative_path() && !folder.has_filename())
  {
    --last; // a slash at the end
  }
  return std::mismatch(folder.begin(), last, path.begin(), path.end()).first == last;
}
} // namespace

bool isNamedBeneath(const std::string& path, const std::string& folder)
{
  std::error_code code;
  const fs::path whole = fs::absolute(path, code).lexically_normal();
  return !code && begins(whole, fs::absolute(folder, code).lexically_normal()) && !code;
}

bool liesBeneath(const std::string& path, const std::string& folder)
{
  std::error_code code;
  const fs::path whole = fs::canonical(path, code);
  return !code && begins(whole, fs::canonical(folder, code)) && !code;
}

std::string folderOfFile(const std::string& path)
{
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

} // namespace dgtk
