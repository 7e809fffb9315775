// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTextureFile.h"

#include "dgtkError.h"
#include "dgtkPcx.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr int largestSide = 16384;
constexpr std::size_t mostTextures = 4096;
constexpr std::size_t mostEntries = 20000;

const char* const imageExtensions[] = { "png", "jpg", "jpeg", "tga", "bmp", "rgb", "rgba", "sgi", "bw", "dds", "gif",
  "tif", "tiff", "ppm", "pgm", "pnm", "pcx" };

std::string lower(std::string text)
{
  for (char& c : text)
  {
    c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  }
  return text;
}

std::string baseName(const std::string& path)
{
  const std::size_t slash = path.find_last_of("/\\:");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// A leading dot belongs to the stem's name: `.body01` is a name without extension.
std::string stemOf(const std::string& name)
{
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

std::string extensionOf(const std::string& name)
{
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot == 0 ? std::string() : lower(name.substr(dot + 1));
}

bool isImageExtension(const std::string& extension)
{
  return std::find(std::begin(imageExtensions), std::end(imageExtensions), extension) != std::end(imageExtensions);
}

bool isFile(const fs::path& path)
{
  std::error_code code;
  return fs::is_regular_file(path, code);
}

/// The stem as DOS programs cut it: "foobarbaz" and "FOOBARBA" agree, and "FOOBAR~1" with both.
bool sameShortStem(const std::string& a, const std::string& b)
{
  const std::size_t tilde = a.find('~');
  if (tilde != std::string::npos && tilde >= 1)
  {
    return b.size() >= tilde && a.compare(0, tilde, b, 0, tilde) == 0;
  }
  return a.size() >= 8 && b.size() >= 8 && a.compare(0, 8, b, 0, 8) == 0;
}

/// Names of the pictures of a folder, sorted.
std::vector<std::string> picturesIn(const fs::path& folder)
{
  std::vector<std::string> names;
  std::error_code code;
  std::size_t seen = 0;
  for (fs::directory_iterator it(folder, code), end; !code && it != end && seen < mostEntries;
       it.increment(code), ++seen)
  {
    const std::string name = it->path().filename().string();
    if (isImageExtension(extensionOf(name)) && isFile(it->path()))
    {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Among the pictures of a folder: the name itself, whatever its case; its stem with another extension, in the order
/// of imageExtensions; a stem that is the same in 8.3 names. "" when there is none.
std::string bestMatch(const std::vector<std::string>& pictures, const std::string& wanted)
{
  const std::string name = lower(wanted);
  const std::string stem = isImageExtension(extensionOf(name)) ? stemOf(name) : name;
  for (const std::string& picture : pictures)
  {
    if (lower(picture) == name)
    {
      return picture;
    }
  }
  for (const bool shortened : { false, true })
  {
    for (const char* extension : imageExtensions)
    {
      for (const std::string& picture : pictures)
      {
        const std::string other = lower(stemOf(picture));
        if (extensionOf(picture) == extension && (shortened ? sameShortStem(stem, other) : other == stem))
        {
          return picture;
        }
      }
    }
  }
  return {};
}
} // namespace

const std::vector<std::string>& TextureFinder::pictures(const std::string& folder)
{
  const auto known = this->Listings.find(folder);
  return known != this->Listings.end() ? known->second
                                       : this->Listings.emplace(folder, picturesIn(folder)).first->second;
}

std::string TextureFinder::find(const std::string& written, std::string* tried)
{
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');
  name.erase(std::find(name.begin(), name.end(), '\0'), name.end());
  const std::string base = baseName(name);
  const fs::path folder = fs::path(this->ModelPath).parent_path();
  if (tried)
  {
    *tried = "as written, " + quoted(base) +
             " beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures";
  }
  const bool relative = !name.empty() && name[0] != '/' && name.find(':') == std::string::npos;
  if (base.empty() || base == "." || base == ".." || name.size() > 4096)
  {
    return {};
  }
  if (relative && isFile(folder / name))
  {
    return (folder / name).lexically_normal().string();
  }
  if (isFile(folder / base))
  {
    return (folder / base).string();
  }
  // in the folder that was written, beside the model, and where games keep their textures
  std::vector<fs::path> folders = { folder, folder / ".." / "textures" };
  if (relative && name != base)
  {
    folders.insert(folders.begin(), folder / fs::path(name).parent_path());
  }
  // a leading dot, in MD2, means the model's own folder
  const std::string wanted = base[0] == '.' ? base.substr(1) : base;
  for (const fs::path& place : folders)
  {
    const std::string match = bestMatch(this->pictures(place.string().empty() ? "." : place.string()), wanted);
    if (!match.empty())
    {
      return (place / match).lexically_normal().string();
    }
  }
  return {};
}

std::string locateTexture(const std::string& modelPath, const std::string& name, std::string* tried)
{
  return TextureFinder(modelPath).find(name, tried);
}

namespace
{
/// Spreads one to four channels to RGBA, in place, from the end.
void spread(Image& image, int channels)
{
  const std::size_t pixels = std::size_t(image.width) * static_cast<std::size_t>(image.height);
  for (std::size_t i = pixels; i-- > 0;)
  {
    const std::uint8_t* from = &image.rgba[i * static_cast<std::size_t>(channels)];
    const bool grey = channels < 3;
    const std::uint8_t color[4] = { from[0], grey ? from[0] : from[1], grey ? from[0] : from[2],
      channels == 2   ? from[1]
      : channels == 4 ? from[3]
                      : std::uint8_t(255) };
    std::copy(color, color + 4, &image.rgba[i * 4]);
  }
}

void settleAlpha(Image& image)
{
  std::uint8_t least = 255;
  std::uint8_t most = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
  {
    least = std::min(least, image.rgba[i]);
    most = std::max(most, image.rgba[i]);
  }
  if (most == 0)
  {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    {
      image.rgba[i] = 255;
    }
  }
  image.hasAlpha = most > 0 && least < 255;
}

std::shared_ptr<Image> decodeWithLibrary(const std::string& path, std::string& problem)
{
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &config);
  if (!input)
  {
    problem = OIIO::geterror();
    return nullptr;
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > largestSide || spec.height > largestSide || spec.depth > 1 ||
      spec.nchannels < 1)
  {
    problem = "is " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels, at most " +
              std::to_string(largestSide) + " a side";
    return nullptr;
  }
  const int channels = std::min(spec.nchannels, 4);
  auto image = std::make_shared<Image>();
  image->width = spec.width;
  image->height = spec.height;
  image->rgba.resize(std::size_t(spec.width) * static_cast<std::size_t>(spec.height) * 4);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, image->rgba.data()))
  {
    problem = input->geterror();
    return nullptr;
  }
  spread(*image, channels);
  return image;
}
} // namespace

std::shared_ptr<const Image> decodeTexture(const std::string& path, std::string& problem)
{
  problem.clear();
  std::shared_ptr<Image> image;
  try
  {
    image =
      extensionOf(baseName(path)) == "pcx" ? decodePcx(path, largestSide, problem) : decodeWithLibrary(path, problem);
  }
  catch (const std::exception& error)
  {
    problem = error.what();
    image.reset();
  }
  if (!image)
  {
    problem = problem.empty() ? "is not a picture" : problem;
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    return nullptr;
  }
  settleAlpha(*image);
  return image;
}

namespace
{
std::shared_ptr<const RadianceImage> readRadiance(const std::string& path, std::string& problem)
{
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
  if (!input)
  {
    problem = OIIO::geterror();
    return nullptr;
  }
  const OIIO::ImageSpec& spec = input->spec();
  const int channels = std::min(spec.nchannels, 3);
  if (spec.width < 1 || spec.height < 1 || spec.width > largestSide || spec.height > largestSide || spec.depth > 1 ||
      channels < 1)
  {
    problem = "is not a picture of 1 to " + std::to_string(largestSide) + " pixels a side";
    return nullptr;
  }
  const std::size_t pixels = std::size_t(spec.width) * static_cast<std::size_t>(spec.height);
  std::vector<float> values(pixels * std::size_t(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
  {
    problem = input->geterror();
    return nullptr;
  }
  const std::string extension = extensionOf(baseName(path));
  const bool linear = extension == "hdr" || extension == "exr" || spec.format.is_floating_point();
  auto image = std::make_shared<RadianceImage>();
  image->width = spec.width;
  image->height = spec.height;
  image->rgb.resize(pixels * 3);
  for (std::size_t i = 0; i < image->rgb.size(); ++i)
  {
    float v = values[i / 3 * std::size_t(channels) + (channels == 3 ? i % 3 : 0)];
    if (!std::isfinite(v))
    {
      problem = "has a value that is not finite";
      return nullptr;
    }
    v = std::max(v, 0.0f);
    image->rgb[i] = linear ? v : v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  }
  return image;
}
} // namespace

std::shared_ptr<const RadianceImage> decodeRadiance(const std::string& path, std::string& problem)
{
  problem.clear();
  std::shared_ptr<const RadianceImage> image;
  try
  {
    image = readRadiance(path, problem);
  }
  catch (const std::exception& error)
  {
    problem = error.what();
  }
  if (!image)
  {
    problem = problem.empty() ? "is not a picture" : problem;
    std::replace(problem.begin(), problem.end(), '\n', ' ');
  }
  return image;
}

bool isCutOut(const Image& image)
{
  if (!image.hasAlpha)
  {
    return false;
  }
  bool holes = false;
  bool solid = false;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
  {
    (image.rgba[i] < 128 ? holes : solid) = true;
  }
  return holes && solid;
}

int TextureCache::add(
  std::vector<Texture>& textures, const std::string& name, std::string& warning, const std::string& alternative)
{
  const auto known = this->ByName.find(name);
  if (known != this->ByName.end())
  {
    return known->second;
  }
  if (textures.size() >= mostTextures)
  {
    warning = "texture " + quoted(name) + " left out: more than " + std::to_string(mostTextures) + " textures";
    return -1;
  }
  std::string tried;
  std::string path = this->Finder.find(name, &tried);
  if (path.empty() && !alternative.empty())
  {
    path = this->Finder.find(alternative);
    tried += ", and " + quoted(alternative);
  }
  const int index = this->addFile(textures, name, path, warning);
  if (path.empty())
  {
    warning = "texture " + quoted(name) + " not found (tried " + tried + ")";
  }
  return index;
}

int TextureCache::addFile(
  std::vector<Texture>& textures, const std::string& name, const std::string& path, std::string& warning)
{
  const int index = static_cast<int>(textures.size());
  textures.push_back({ name, path, nullptr });
  this->ByName[name] = index;
  if (path.empty() || !this->Options.decodeTextures)
  {
    return index;
  }
  const auto known = this->ByPath.find(path);
  if (known != this->ByPath.end())
  {
    textures.back().image = known->second;
    return index;
  }
  std::string problem;
  textures.back().image = decodeTexture(path, problem);
  this->ByPath[path] = textures.back().image;
  if (!textures.back().image)
  {
    warning = "texture " + path + " cannot be decoded: " + problem;
  }
  return index;
}

} // namespace dgtk
