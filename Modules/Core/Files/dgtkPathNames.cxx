// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPathNames.h"

#include <filesystem>
#include <system_error>

namespace dgtk
{

namespace fs = std::filesystem;

namespace
{
/// Whether the last part of a path names a file or folder that is there, and no link.
bool endsInNoLink(const fs::path& path)
{
  const fs::path leaf = path.filename();
  if (leaf.empty() || leaf == "." || leaf == "..")
  {
    return false;
  }
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path, error).type();
  return type == fs::file_type::regular || type == fs::file_type::directory;
}
} // namespace

const std::string& PathNames::of(const std::string& path)
{
  const auto [entry, isNew] = this->Known.try_emplace(path);
  std::string& name = entry->second;
  if (!isNew)
  {
    return name;
  }
  std::error_code error;
  const fs::path whole = fs::absolute(path.empty() ? "." : path, error);
  if (!error && endsInNoLink(whole))
  {
    name = (fs::path(this->of(whole.parent_path().string())) / whole.filename()).string();
    return name;
  }
  const fs::path found = error ? whole : fs::weakly_canonical(whole, error);
  name = error ? fs::path(path).lexically_normal().string() : found.string();
  return name;
}

std::string PathNames::relative(const std::string& path, const std::string& folder)
{
  const std::string& from = this->of(folder);
  return fs::path(this->of(path)).lexically_relative(from).generic_string();
}

std::string tidied(const std::string& path)
{
  const std::string out = "/..";
  const bool ends = path.size() > out.size() && path.compare(path.size() - out.size(), out.size(), out) == 0;
  const std::size_t last = ends ? path.size() - out.size() : path.rfind(out + '/');
  if (last == std::string::npos)
  {
    return path;
  }
  const fs::path folder = path.substr(0, last + out.size());
  std::error_code error;
  const bool isSame = fs::equivalent(folder, folder.lexically_normal(), error) && !error;
  return isSame ? fs::path(path).lexically_normal().string() : path;
}

} // namespace dgtk
