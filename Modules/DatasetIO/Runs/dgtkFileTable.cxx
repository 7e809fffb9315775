// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFileTable.h"

#include <algorithm>
#include <cstdio>
#include <tuple>

namespace dgtk
{

namespace
{
constexpr const char* hexadecimals = "0123456789abcdef";

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
    text += { hexadecimals[byte >> 4], hexadecimals[byte & 15] };
  }
  return text;
}

/// As files have a frame.
std::string digitsOf(int frame)
{
  char digits[16];
  std::snprintf(digits, sizeof digits, "%06d", frame);
  return digits;
}

/// The place of what is kept once; where it is new, behind the others.
template <typename Key, typename Value>
std::uint32_t numberOf(
  std::map<Key, std::uint32_t>& numbers, std::vector<Value>& values, const Key& key, const Value& value)
{
  const auto [found, fresh] = numbers.emplace(key, static_cast<std::uint32_t>(values.size()));
  if (fresh)
  {
    values.push_back(value);
  }
  return found->second;
}
} // namespace

std::uint32_t FileTable::layerNumber(const std::string& layer)
{
  const auto known = std::find(this->Layers.begin(), this->Layers.end(), layer);
  const auto number = static_cast<std::uint32_t>(known - this->Layers.begin());
  if (known == this->Layers.end())
  {
    this->Layers.push_back(layer);
    this->OfShots.push_back(false);
  }
  return number;
}

void FileTable::add(const DatasetFile& file, std::uint32_t shot)
{
  Entry entry;
  entry.bytes = file.bytes;
  entry.hash = packed(file.sha256);
  entry.shot = shot;
  std::string rest = file.path;
  if (rest.compare(0, file.camera.size(), file.camera) == 0)
  {
    rest.erase(0, file.camera.size());
    entry.camera = numberOf(this->CameraNumbers, this->Cameras, file.camera, file.camera);
  }
  const std::uint32_t layer = this->layerNumber(file.layer);
  this->OfShots[layer] = this->OfShots[layer] || shot != noShot;
  const std::string digits = file.frame < 0 ? std::string() : digitsOf(file.frame);
  const std::size_t name = rest.rfind('/') + 1;
  Form form{ rest, {}, layer };
  if (!digits.empty() && rest.compare(name, digits.size(), digits) == 0)
  {
    form = { rest.substr(0, name), rest.substr(name + digits.size()), layer };
    entry.frame = file.frame;
  }
  entry.form = numberOf(this->FormNumbers, this->Forms, { form.before, form.after, file.layer }, form);
  this->Entries.push_back(entry);
  this->Sorted = this->Sorted && (this->Entries.size() == 1 || this->LastPath < file.path);
  this->LastPath = file.path;
}

std::string FileTable::pathOf(const Entry& entry) const
{
  const Form& form = this->Forms[entry.form];
  return this->Cameras[entry.camera] + form.before + (entry.frame < 0 ? "" : digitsOf(entry.frame)) + form.after;
}

void FileTable::finish()
{
  if (!this->Sorted) // manifests are
  {
    std::sort(this->Entries.begin(), this->Entries.end(),
      [this](const Entry& a, const Entry& b) { return this->pathOf(a) < this->pathOf(b); });
  }
  this->CameraNumbers.clear();
  this->FormNumbers.clear();
  const auto withShot =
    std::count_if(this->Entries.begin(), this->Entries.end(), [](const Entry& entry) { return entry.shot != noShot; });
  this->ByShot.clear();
  this->ByShot.reserve(std::size_t(withShot));
  for (std::size_t i = 0; i < this->Entries.size(); ++i)
  {
    if (this->Entries[i].shot != noShot)
    {
      this->ByShot.push_back(std::uint32_t(i));
    }
  }
  const auto place = [this](std::uint32_t i)
  { return std::make_tuple(this->Entries[i].shot, this->layerOf(this->Entries[i]), i); };
  std::sort(
    this->ByShot.begin(), this->ByShot.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
}

std::optional<std::uint32_t> FileTable::find(const std::string& path) const
{
  const auto found = std::lower_bound(this->Entries.begin(), this->Entries.end(), path,
    [this](const Entry& entry, const std::string& wanted) { return this->pathOf(entry) < wanted; });
  const bool known = found != this->Entries.end() && this->pathOf(*found) == path;
  return known ? std::optional<std::uint32_t>(std::uint32_t(found - this->Entries.begin())) : std::nullopt;
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
    files.erase(std::remove_if(files.begin(), files.end(),
                  [&](std::uint32_t i) { return this->layerOf(this->Entries[i]) != number; }),
      files.end());
  }
  return files;
}

bool FileTable::hasLayer(const std::string& layer) const
{
  const auto known = std::find(this->Layers.begin(), this->Layers.end(), layer);
  return known != this->Layers.end() && this->OfShots[std::size_t(known - this->Layers.begin())];
}

DatasetFile FileTable::at(std::uint32_t number) const
{
  const Entry& entry = this->Entries[number];
  DatasetFile file;
  file.path = this->pathOf(number);
  file.bytes = entry.bytes;
  file.sha256 = unpacked(entry.hash);
  file.layer = this->Layers[this->layerOf(entry)];
  return file;
}

} // namespace dgtk
