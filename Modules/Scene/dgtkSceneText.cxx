// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneText.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace dgtk::scenefile
{

namespace fs = std::filesystem;

std::string parseNumber(std::string_view text, double& value)
{
  if (!text.empty() && text[0] == '+')
  {
    text.remove_prefix(1);
  }
  double read = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), read);
  if (result.ec == std::errc::result_out_of_range)
  {
    return "a number within the range of double precision";
  }
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
  {
    return "a number";
  }
  if (!std::isfinite(read))
  {
    return "a finite number";
  }
  value = read;
  return {};
}

std::string Relocation::of(const std::string& path)
{
  if (path.empty() || path[0] == '/' || this->From == this->To)
  {
    return path;
  }
  const fs::path from = this->Names.of(this->From);
  const fs::path to = this->Names.of(this->To);
  if (from == to)
  {
    return path;
  }
  const fs::path file = from / path;
  const fs::path target = fs::path(this->Names.of(file.parent_path().string())) / file.filename();
  return target.lexically_relative(to).generic_string();
}

std::string stemOf(const std::string& path) { return fs::path(path).stem().string(); }

} // namespace dgtk::scenefile
