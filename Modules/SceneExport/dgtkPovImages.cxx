// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovImages.h"

#include "dgtkCutOutColors.h"
#include "dgtkFile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace dgtk
{

namespace
{
bool plain(char c)
{
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || std::strchr("-_.,+ ()/", c);
}

/// A PNG whose header says gray, RGB or palette.
bool isPlainPng(const std::string& path)
{
  char header[26] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(header, sizeof header) && std::memcmp(header, "\x89PNG\r\n\x1a\n", 8) == 0 &&
         (header[25] == 0 || header[25] == 2 || header[25] == 3);
}

std::string colorEnd(int number) { return '_' + std::to_string(number) + ".ppm"; }
std::string maskEnd(int number) { return '_' + std::to_string(number) + "_mask.pgm"; }

std::string pnmHeader(const char* kind, const Image& image)
{
  return std::string(kind) + '\n' + std::to_string(image.width) + ' ' + std::to_string(image.height) + "\n255\n";
}
} // namespace

std::string povPpm(const Image& image, const Eigen::Vector3d& tint, bool cutOut)
{
  const std::vector<std::uint8_t> filled = cutOut ? withoutHoles(image) : std::vector<std::uint8_t>();
  const std::vector<std::uint8_t>& rgba = cutOut ? filled : image.rgba;
  std::string text = pnmHeader("P6", image);
  text.reserve(text.size() + rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); ++i)
  {
    if (i % 4 != 3)
    {
      text += static_cast<char>(std::lround(rgba[i] * tint[Eigen::Index(i % 4)]));
    }
  }
  return text;
}

std::string povMaskPgm(const Image& image)
{
  std::string text = pnmHeader("P5", image);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
  {
    text += image.rgba[i] < 128 ? '\0' : '\xff';
  }
  return text;
}

bool povReads(const Texture& texture)
{
  return !texture.path.empty() && !texture.image->hasAlpha && isPlainPng(texture.path);
}

std::string povPlainName(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](char c) { return !plain(c) || c == '/'; }, '_');
  return name;
}

PovImagesBeside::PovImagesBeside(const std::string& scene, std::vector<std::string> inputs)
  : Inputs(std::move(inputs))
{
  const std::filesystem::path path(scene);
  this->Folder = path.parent_path().string();
  this->Stem = povPlainName(path.stem().string());
}

/// The texture's own file, relative to the scene, or "" when it does not serve.
std::string PovImagesBeside::own(const Texture& texture) const
{
  if (!povReads(texture))
  {
    return {};
  }
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(this->Folder.empty() ? "." : this->Folder, error);
  const std::string relative =
    std::filesystem::relative(std::filesystem::absolute(texture.path, error), folder, error).generic_string();
  return std::all_of(relative.begin(), relative.end(), plain) ? relative : std::string();
}

int PovImagesBeside::number(const Image& image, const Eigen::Vector3d& tint, bool cutOut)
{
  const auto [entry, isNew] = this->Numbers.try_emplace({ &image, tint.x(), tint.y(), tint.z(), cutOut }, 0);
  if (isNew)
  {
    while (leadsToOneOf(this->pathOf(colorEnd(this->Next)), this->Inputs) ||
           leadsToOneOf(this->pathOf(maskEnd(this->Next)), this->Inputs))
    {
      ++this->Next;
    }
    entry->second = this->Next++;
  }
  return entry->second;
}

std::string PovImagesBeside::pathOf(const std::string& end) const
{
  return (std::filesystem::path(this->Folder) / (this->Stem + end)).string();
}

std::string PovImagesBeside::write(const std::string& end, const std::string& contents)
{
  const std::string path = this->pathOf(end);
  writeFile(path, contents);
  this->Files.push_back(path);
  return this->Stem + end;
}

std::string PovImagesBeside::color(const Texture& texture, const Eigen::Vector3d& tint, bool cutOut)
{
  const Image& image = *texture.image;
  const std::string relative = tint == Eigen::Vector3d(1, 1, 1) ? this->own(texture) : std::string();
  if (!relative.empty())
  {
    return "png \"" + relative + '"';
  }
  const std::string end = colorEnd(this->number(image, tint, cutOut));
  std::string& reference = this->Written[end];
  if (reference.empty())
  {
    reference = "ppm \"" + this->write(end, povPpm(image, tint, cutOut)) + '"';
  }
  return reference;
}

std::string PovImagesBeside::mask(const Texture& texture)
{
  const Image& image = *texture.image;
  const std::string end = maskEnd(this->number(image, Eigen::Vector3d(1, 1, 1), true));
  std::string& reference = this->Written[end];
  if (reference.empty())
  {
    reference = "pgm \"" + this->write(end, povMaskPgm(image)) + '"';
  }
  return reference;
}

} // namespace dgtk
