// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace dgtk
{

std::string lower(std::string text)
{
  std::transform(
    text.begin(), text.end(), text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

std::string extensionOf(const std::string& path)
{
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

std::string joined(const std::vector<std::string>& words, const char* separator)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (&word == words.data() ? "" : separator) + word;
  }
  return text;
}

std::string shortest(double value)
{
  if (std::isnan(value))
  {
    return "nan";
  }
  char text[32];
  return { text, std::to_chars(text, text + sizeof text, value).ptr };
}

std::string plainNumber(double value)
{
  const double size = std::abs(value);
  if (size < 1e-6 || !(size < 1e15))
  {
    return shortest(value);
  }
  char text[64];
  return { text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr };
}

namespace
{
std::size_t editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
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
} // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& candidates)
{
  if (word.size() > 64)
  {
    return {};
  }
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2) + 1;
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

} // namespace dgtk
