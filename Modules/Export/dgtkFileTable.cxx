// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFileTable.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <tuple>

namespace dgtk
{

namespace
{
constexpr const char* digits = "0123456789abcdef";

std::array<std::uint8_t, 32> packed(const std::string& hexadecimal)
{
  const auto digit = [](char c) { return static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10); };
  std::array<std::uint8_t, 32> bytes = {};
  for (std::size_t i = 0; 2 * i + 1 < hexadecimal.size() && i < bytes.size(); ++i)
  {
    bytes[i] = static_cast<std::uint8_t>(digit(hexadecimal[2 * i]) << 4 | digit(hexadecimal[2 * i + 1]));
  }
  return bytes;
}

std::string unpacked(const std::array<std::uint8_t, 32>& bytes)
{
  std::string text;
  for (const std::uint8_t byte : bytes)
  {
    text += { digits[byte >> 4], digits[byte & 15] };
  }
  return text;
}
} // namespace

void FileTable::add(const DatasetFile& file, std::uint32_t shot)
{
  const auto known = std::find(this->Layers.begin(), this->Layers.end(), file.layer);
  const auto layer = static_cast<std::uint32_t>(known - this->Layers.begin());
  if (known == this->Layers.end())
  {
    this->Layers.push_back(file.layer);
    this->OfShots.push_back(false);
  }
  this->OfShots[layer] = this->OfShots[layer] || shot != noShot;
  this->Entries.push_back(
    { this->Paths.size(), file.bytes, packed(file.sha256), static_cast<std::uint32_t>(file.path.size()), shot, layer });
  this->Paths += file.path;
}

int FileTable::compare(const Entry& entry, const std::string& path) const
{
  return std::string_view(this->Paths).substr(entry.path, entry.length).compare(path);
}

void FileTable::finish()
{
  this->Paths.shrink_to_fit();
  this->Entries.shrink_to_fit();
  this->ByPath.resize(this->Entries.size());
  std::iota(this->ByPath.begin(), this->ByPath.end(), 0);
  const std::string_view paths = this->Paths;
  const auto path = [&](std::uint32_t i) { return paths.substr(this->Entries[i].path, this->Entries[i].length); };
  std::sort(
    this->ByPath.begin(), this->ByPath.end(), [&](std::uint32_t a, std::uint32_t b) { return path(a) < path(b); });
  this->ByShot.clear();
  std::copy_if(this->ByPath.begin(), this->ByPath.end(), std::back_inserter(this->ByShot),
    [this](std::uint32_t i) { return this->Entries[i].shot != noShot; });
  this->ByShot.shrink_to_fit();
  std::stable_sort(this->ByShot.begin(), this->ByShot.end(),
    [this](std::uint32_t a, std::uint32_t b)
    {
      const Entry& one = this->Entries[a];
      const Entry& other = this->Entries[b];
      return std::tie(one.shot, one.layer) < std::tie(other.shot, other.layer);
    });
}

std::optional<std::uint32_t> FileTable::find(const std::string& path) const
{
  const auto found = std::lower_bound(this->ByPath.begin(), this->ByPath.end(), path,
    [this](std::uint32_t i, const std::string& wanted) { return this->compare(this->Entries[i], wanted) < 0; });
  const bool known = found != this->ByPath.end() && this->compare(this->Entries[*found], path) == 0;
  return known ? std::optional<std::uint32_t>(*found) : std::nullopt;
}

std::vector<std::uint32_t> FileTable::ofShot(std::uint32_t shot) const
{
  const auto first = std::lower_bound(this->ByShot.begin(), this->ByShot.end(), shot,
    [this](std::uint32_t i, std::uint32_t wanted) { return this->Entries[i].shot < wanted; });
  const auto last =
    std::find_if(first, this->ByShot.end(), [&](std::uint32_t i) { return this->Entries[i].shot != shot; });
  return { first, last };
}

std::vector<std::uint32_t> FileTable::ofShot(std::uint32_t shot, const std::string& layer) const
{
  const auto known = std::find(this->Layers.begin(), this->Layers.end(), layer);
  std::vector<std::uint32_t> files;
  if (known != this->Layers.end())
  {
    files = this->ofShot(shot);
    const auto number = static_cast<std::uint32_t>(known - this->Layers.begin());
    files.erase(
      std::remove_if(files.begin(), files.end(), [&](std::uint32_t i) { return this->Entries[i].layer != number; }),
      files.end());
  }
  return files;
}

bool FileTable::hasLayer(const std::string& layer) const
{
  const auto known = std::find(this->Layers.begin(), this->Layers.end(), layer);
  return known != this->Layers.end() && this->OfShots[std::size_t(known - this->Layers.begin())];
}

std::string FileTable::pathOf(std::uint32_t number) const
{
  return this->Paths.substr(this->Entries[number].path, this->Entries[number].length);
}

DatasetFile FileTable::at(std::uint32_t number) const
{
  const Entry& entry = this->Entries[number];
  DatasetFile file;
  file.path = this->pathOf(number);
  file.bytes = entry.bytes;
  file.sha256 = unpacked(entry.hash);
  file.layer = this->Layers[entry.layer];
  return file;
}

} // namespace dgtk
