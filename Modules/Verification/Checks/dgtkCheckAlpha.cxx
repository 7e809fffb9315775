// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkSampledPixels.h"

#include <cmath>
#include <cstring>
#include <map>

namespace dgtk
{

namespace
{
constexpr double full = 255;
/// Half a step of 8 bits.
constexpr double alphaRounding = 0.5 / full;

std::uint32_t rotate(std::uint32_t value, int bits) { return value << bits | value >> (32 - bits); }

/// MurmurHash3_x86_32 with seed 0 (Appleby).
std::uint32_t murmur(const std::string& text)
{
  const auto scramble = [](std::uint32_t k) { return rotate(k * 0xCC9E2D51u, 15) * 0x1B873593u; };
  std::uint32_t hash = 0;
  std::size_t at = 0;
  for (; at + 4 <= text.size(); at += 4)
  {
    std::uint32_t block;
    std::memcpy(&block, text.data() + at, 4);
    hash = rotate(hash ^ scramble(block), 13) * 5 + 0xE6546B64u;
  }
  std::uint32_t rest = 0;
  for (std::size_t i = text.size(); i > at; --i)
  {
    rest = rest << 8 | static_cast<unsigned char>(text[i - 1]);
  }
  hash ^= scramble(rest);
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16) * 0x85EBCA6Bu;
  hash = (hash ^ hash >> 13) * 0xC2B2AE35u;
  return hash ^ hash >> 16;
}

/// Cryptomatte's number for a name, as the bits of a float.
std::uint32_t cryptomatteBits(const std::string& name)
{
  const std::uint32_t hash = murmur(name);
  const std::uint32_t exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

std::uint32_t bitsOf(double value)
{
  const float narrow = static_cast<float>(value);
  std::uint32_t bits;
  std::memcpy(&bits, &narrow, 4);
  return bits;
}

/// Ids of a coverage file by Cryptomatte's numbers.
std::map<std::uint32_t, std::uint32_t> idsByBits(const Dataset& dataset)
{
  std::map<std::uint32_t, std::uint32_t> ids{ { 0, 0 } };
  std::map<std::string, int> seen;
  for (const ObjectRecord& object : dataset.objects())
  {
    const bool again = seen[object.name]++ > 0;
    ids[cryptomatteBits(again ? object.name + '#' + std::to_string(object.id) : object.name)] = object.id;
  }
  return ids;
}

/// The ranks of a pixel. In the file channels stand by name: a, b, g, r of the first two ranks, then of the next two.
class Coverage
{
public:
  Coverage(PicturePointer file, const Dataset& dataset)
    : File(std::move(file))
    , Ids(idsByBits(dataset))
  {
  }
  const PictureFile& file() const { return *this->File; }
  int ranks() const { return this->File->channels() / 2; }
  double share(int x, int y, int rank) const { return this->File->at(x, y, rank / 2 * 4 + (rank % 2 == 0 ? 2 : 0)); }
  /// -1 for the number of no object.
  std::int64_t id(int x, int y, int rank) const
  {
    const auto found = this->Ids.find(bitsOf(this->File->at(x, y, rank / 2 * 4 + (rank % 2 == 0 ? 3 : 1))));
    return found == this->Ids.end() ? -1 : std::int64_t(found->second);
  }
  double shareOf(std::uint32_t id, int x, int y) const
  {
    double sum = 0;
    for (int rank = 0; rank < this->ranks(); ++rank)
    {
      sum += this->id(x, y, rank) == id ? this->share(x, y, rank) : 0;
    }
    return sum;
  }

private:
  PicturePointer File;
  std::map<std::uint32_t, std::uint32_t> Ids;
};

void checkSums(const Coverage& coverage, int x, int y, Meter& meter)
{
  double sum = 0;
  double before = infinite;
  bool sound = true;
  for (int rank = 0; rank < coverage.ranks(); ++rank)
  {
    const double share = coverage.share(x, y, rank);
    sum += share;
    sound = sound && share >= 0 && share <= before && coverage.id(x, y, rank) >= 0;
    before = share;
  }
  meter.add(sound ? sum - 1 : infinite,
    [&]
    {
      return coverage.file().offender(x, y, sound ? "ranks of sum " + numberText(sum) : "a rank of no object or order",
        "falling shares of known objects of sum 1");
    });
}

/// Coverage counted anew, of all objects of a pixel: all divided pixels, and some of the others.
void checkSamples(const Coverage& coverage, const Samples& samples, int x, int y, Meter& meter)
{
  if (coverage.share(x, y, 0) == 1 && !Samples::isChosen(x, y))
  {
    return;
  }
  for (const auto& [id, count] : samples.at(x, y).counts)
  {
    const double share = coverage.shareOf(id, x, y);
    samples.compare(x, y, id, share, 0, meter,
      [&, object = id](double expected)
      {
        return coverage.file().offender(
          x, y, "object " + std::to_string(object) + ", coverage " + numberText(share), numberText(expected));
      });
  }
}

/// A known object, and the share that coverage has of it.
void checkShare(const PictureFile& alpha, const Coverage& coverage, std::size_t objects, int x, int y, Meter& meter)
{
  const std::uint32_t id = alpha.id(x, y);
  const double share = alpha.at(x, y, 3) / full;
  const double expected = id <= objects ? coverage.shareOf(id, x, y) : 0;
  const double error = share > 0 && expected > 0 ? std::abs(share - expected) - alphaRounding : infinite;
  meter.add(std::max(0.0, error),
    [&]
    {
      return alpha.offender(x, y, "object " + std::to_string(id) + ", alpha " + numberText(share),
        expected > 0 ? numberText(expected) : "an object of the pixel, alpha above 0");
    });
}

/// The object of the nearest sample and its share, counted anew.
void checkNearest(const PictureFile& alpha, const Samples& samples, int x, int y, Meter& meter)
{
  const double share = alpha.at(x, y, 3) / full;
  if (share == 1 && !Samples::isChosen(x, y))
  {
    return;
  }
  const std::uint32_t found = alpha.id(x, y);
  const SampledPixel& pixel = samples.at(x, y);
  if (found != pixel.nearest)
  {
    if (pixel.isDoubtful(found) || pixel.isDoubtful(pixel.nearest))
    {
      meter.skip();
      return;
    }
    meter.equal(false, [&]
      { return alpha.offender(x, y, "object " + std::to_string(found), "object " + std::to_string(pixel.nearest)); });
    return;
  }
  samples.compare(x, y, found, share, alphaRounding, meter,
    [&](double expected)
    {
      return alpha.offender(
        x, y, "object " + std::to_string(found) + ", alpha " + numberText(share), numberText(expected));
    });
}
} // namespace

void checkAlpha(Picture& picture, Results& results)
{
  const PicturePointer file = picture.image("coverage", { ".exr" });
  const std::unique_ptr<Coverage> coverage =
    file && file->channels() % 4 == 0 ? std::make_unique<Coverage>(file, picture.dataset()) : nullptr;
  const Samples samples(picture);
  const auto measure = [&](const Row& row, const auto& pixel)
  {
    results.add(row, meterRows(picture.pool(), picture.height(), coverageTolerance,
                       [&](int y, Meter& meter)
                       {
                         for (int x = 0; x < picture.width(); ++x)
                         {
                           pixel(x, y, meter);
                         }
                       }));
  };
  if (coverage)
  {
    measure({ "coverage", "coverage", { file->file() } },
      [&](int x, int y, Meter& meter) { checkSums(*coverage, x, y, meter); });
    measure({ "samples", "coverage", { file->file() }, mostOpenSamples },
      [&](int x, int y, Meter& meter) { checkSamples(*coverage, samples, x, y, meter); });
  }
  const PicturePointer alpha = picture.image("alpha", { ".png" });
  if (alpha && alpha->channels() == 4)
  {
    const std::size_t objects = picture.dataset().objects().size();
    if (coverage)
    {
      measure({ "alpha", "coverage", { alpha->file() } },
        [&](int x, int y, Meter& meter) { checkShare(*alpha, *coverage, objects, x, y, meter); });
    }
    measure({ "nearest", "coverage", { alpha->file() }, mostOpenSamples },
      [&](int x, int y, Meter& meter) { checkNearest(*alpha, samples, x, y, meter); });
  }
}

} // namespace dgtk
