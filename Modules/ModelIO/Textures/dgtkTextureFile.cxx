// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTextureFile.h"

#include "dgtkError.h"
#include "dgtkPictureProcess.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"
#include "dgtkTexturePixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>

namespace dgtk
{

namespace
{
const char* const budgetVariable = "DGTK_TEXTURE_MEMORY";
constexpr std::uint64_t mebibyte = std::uint64_t(1) << 20;
constexpr std::uint64_t defaultBudget = 4096 * mebibyte;

std::uint64_t budgetOfEnvironment()
{
  const char* text = std::getenv(budgetVariable);
  if (!text || !*text)
  {
    return defaultBudget;
  }
  const std::string digits = text;
  if (digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
  {
    throw MachineError(std::string(budgetVariable) + " is not a number of MiB: " + quoted(digits));
  }
  return std::stoull(digits) * mebibyte;
}

std::string inMebibytes(std::uint64_t bytes) { return std::to_string((bytes + mebibyte - 1) / mebibyte) + " MiB"; }
} // namespace

/// A picture of a scene.
struct TextureStore::Entry
{
  std::mutex work; ///< what throws is done again by who asks next
  struct Decoded
  {
    bool isDone = false;
    std::string problem;
    std::shared_ptr<const Image> image;
  };
  bool isMeasured = false;
  bool isPicture = false;
  std::string problem;
  picture::Answer size;
  std::array<Decoded, 2> uses;
};

TextureStore::TextureStore()
  : TextureStore(budgetOfEnvironment())
{
}

TextureStore::TextureStore(std::uint64_t bytes)
  : Limit(bytes)
{
}

TextureStore::~TextureStore() = default;

void TextureStore::take(const std::string& picture, int width, int height, std::uint64_t bytes)
{
  const std::uint64_t sum = this->Taken += bytes;
  if (sum > this->Limit)
  {
    throw MachineError(picture + ": a texture of " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels; with it, all textures take " + inMebibytes(sum) + " of memory, more than the " +
                       inMebibytes(this->Limit) + " that they may (" + budgetVariable + " raises it)");
  }
}

namespace
{
std::string oneLine(std::string problem)
{
  problem = problem.empty() ? "is not a picture" : problem;
  std::replace(problem.begin(), problem.end(), '\n', ' ');
  return problem;
}

/// One to four channels as RGBA.
std::shared_ptr<Image> spread(const picture::Answer& size, const std::uint8_t* from)
{
  auto image = std::make_shared<Image>();
  image->width = size.width;
  image->height = size.height;
  const std::size_t pixels = std::size_t(size.width) * std::size_t(size.height);
  const auto channels = static_cast<std::size_t>(size.channels);
  image->rgba.resize(pixels * 4);
  std::uint8_t* to = image->rgba.data();
  for (std::size_t i = 0; i < pixels; ++i, from += channels, to += 4)
  {
    const bool grey = channels < 3;
    to[0] = from[0];
    to[1] = grey ? from[0] : from[1];
    to[2] = grey ? from[0] : from[2];
    to[3] = channels == 2 ? from[1] : channels == 4 ? from[3] : std::uint8_t(255);
  }
  return image;
}

std::shared_ptr<RadianceImage> toLight(const picture::Answer& size, const float* values, std::string& problem)
{
  auto image = std::make_shared<RadianceImage>();
  image->width = size.width;
  image->height = size.height;
  image->rgb.resize(std::size_t(size.width) * std::size_t(size.height) * 3);
  const auto channels = static_cast<std::size_t>(size.channels);
  for (std::size_t i = 0; i < image->rgb.size(); ++i)
  {
    float v = values[i / 3 * channels + (channels == 3 ? i % 3 : 0)];
    if (!std::isfinite(v))
    {
      problem = "has a value that is not finite";
      return nullptr;
    }
    v = std::max(v, 0.0f);
    image->rgb[i] = size.linear != 0 ? v : portable::linearFromEncoded(v);
  }
  return image;
}

bool takeBytes(const picture::Source& source, picture::Values values, std::uint64_t pixelBytes, TextureStore& store,
  picture::Answer& size, std::string& problem)
{
  problem.clear();
  if (!picture::measure(source, values, size, problem))
  {
    problem = oneLine(problem);
    return false;
  }
  const std::uint64_t pixels = std::uint64_t(size.width) * std::uint64_t(size.height);
  store.take(source.path, size.width, size.height, pixels * pixelBytes);
  return true;
}

/// `make` makes the image of the pixels; null when it cannot, with `problem` set.
template <class Make>
auto decodePixels(const picture::Source& source, picture::Values values, std::string& problem, Make make)
  -> decltype(make(picture::Answer(), picture::Pixels()))
{
  try
  {
    picture::Answer size;
    picture::Pixels pixels;
    if (picture::decode(source, values, size, pixels, problem))
    {
      return make(size, pixels);
    }
    problem = oneLine(problem);
    return nullptr;
  }
  catch (const std::bad_alloc&)
  {
    throw MachineError(source.path + ": cannot be decoded: not enough memory");
  }
}

picture::Source fileSource(const std::string& path) { return { path, extensionOf(path), nullptr }; }
} // namespace

void settleAlpha(Image& image, AlphaRule rule)
{
  std::uint8_t least = 255;
  std::uint8_t most = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
  {
    least = std::min(least, image.rgba[i]);
    most = std::max(most, image.rgba[i]);
  }
  if (most == 0 && rule == AlphaRule::Painted)
  {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    {
      image.rgba[i] = 255;
    }
    least = 255;
  }
  image.hasAlpha = least < 255;
}

bool takeTexels(const picture::Source& source, TextureStore& store, picture::Answer& size, std::string& problem)
{
  return takeBytes(source, picture::Values::Codes, 4, store, size, problem);
}

std::shared_ptr<const Image> decodeTexels(
  const picture::Source& source, TextureUse use, AlphaRule rule, std::string& problem)
{
  return decodePixels(source, use == TextureUse::Color ? picture::Values::Codes : picture::Values::Bytes, problem,
    [rule](const picture::Answer& size, const picture::Pixels& pixels)
    {
      std::shared_ptr<Image> image = spread(size, pixels.as<std::uint8_t>());
      settleAlpha(*image, rule);
      return image;
    });
}

TextureStore::Entry& TextureStore::entryOf(const std::string& path)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  std::unique_ptr<Entry>& entry = this->Entries[path];
  entry = entry ? std::move(entry) : std::make_unique<Entry>();
  return *entry;
}

bool TextureStore::reserve(const std::string& path, std::string& problem)
{
  Entry& entry = this->entryOf(path);
  const std::lock_guard<std::mutex> lock(entry.work);
  if (!entry.isMeasured)
  {
    entry.isPicture = takeTexels(fileSource(path), *this, entry.size, entry.problem);
    entry.isMeasured = true;
  }
  problem = entry.problem;
  return entry.isPicture;
}

std::shared_ptr<const Image> TextureStore::decode(const std::string& path, TextureUse use, std::string& problem)
{
  Entry& entry = this->entryOf(path);
  const std::lock_guard<std::mutex> lock(entry.work);
  const bool isData = use == TextureUse::Data && entry.size.linear != 0; // otherwise both uses are one
  Entry::Decoded& decoded = entry.uses.at(isData ? 1 : 0);
  if (!decoded.isDone)
  {
    if (entry.uses.at(isData ? 0 : 1).image)
    {
      const picture::Answer& size = entry.size;
      this->take(
        path, size.width, size.height, std::uint64_t(4) * std::uint64_t(size.width) * std::uint64_t(size.height));
    }
    decoded.image = decodeTexels(
      fileSource(path), isData ? TextureUse::Data : TextureUse::Color, AlphaRule::Painted, decoded.problem);
    decoded.isDone = true;
  }
  problem = decoded.problem;
  return decoded.image;
}

std::shared_ptr<const Image> decodeTexture(
  const std::string& path, std::string& problem, TextureStore* store, TextureUse use)
{
  TextureStore own;
  TextureStore& used = store ? *store : own;
  return used.reserve(path, problem) ? used.decode(path, use, problem) : nullptr;
}

std::shared_ptr<const RadianceImage> decodeRadiance(const std::string& path, std::string& problem, TextureStore* store)
{
  TextureStore own;
  const picture::Source source = fileSource(path);
  picture::Answer header;
  if (!takeBytes(source, picture::Values::Floats, 3 * sizeof(float), store ? *store : own, header, problem))
  {
    return nullptr;
  }
  return decodePixels(source, picture::Values::Floats, problem,
    [&problem](const picture::Answer& size, const picture::Pixels& pixels)
    { return toLight(size, pixels.as<float>(), problem); });
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

} // namespace dgtk
