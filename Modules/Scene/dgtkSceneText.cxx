// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace dgtk::scenefile
{

namespace fs = std::filesystem;

std::string numberText(double value)
{
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value);
  std::string shortest(text, end.ptr);
  // to_chars prefers an exponent only where it is shorter; 100000 becomes 1e+05, which is harder to read.
  const double size = std::abs(value);
  if (shortest.find('e') != std::string::npos && size >= 1e-6 && size < 1e15)
  {
    const auto plain = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
    shortest.assign(text, plain.ptr);
  }
  return shortest;
}

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

namespace
{
std::size_t editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
  {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({ replaced, row[j] + 1, row[j - 1] + 1 });
    }
  }
  return row[b.size()];
}

std::string lower(std::string text)
{
  std::transform(
    text.begin(), text.end(), text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

fs::path canonicalFolder(const std::string& folder)
{
  std::error_code error;
  const fs::path path = folder.empty() ? fs::path(".") : fs::path(folder);
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path), error);
  return error ? path.lexically_normal() : canonical;
}
} // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& candidates)
{
  if (word.size() > 64)
  {
    return {};
  }
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates)
  {
    const std::size_t distance = editDistance(lower(word), lower(candidate));
    if (distance < least)
    {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string relocate(const std::string& path, const std::string& fromFolder, const std::string& toFolder)
{
  if (path.empty() || path[0] == '/' || fromFolder == toFolder)
  {
    return path;
  }
  const fs::path from = canonicalFolder(fromFolder);
  const fs::path to = canonicalFolder(toFolder);
  if (from == to)
  {
    return path;
  }
  const fs::path file = from / path;
  const fs::path target = canonicalFolder(file.parent_path().string()) / file.filename();
  return target.lexically_relative(to).generic_string();
}

std::string stemOf(const std::string& path) { return fs::path(path).stem().string(); }

std::string extensionOf(const std::string& path)
{
  const std::string extension = lower(fs::path(path).extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

} // namespace dgtk::scenefile
