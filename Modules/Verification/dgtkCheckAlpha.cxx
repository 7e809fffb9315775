// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
constexpr double CoverageTolerance = 1e-6;
/// Half a step of 8 bits.
constexpr double AlphaRounding = 0.5 / 255;

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
  double before = Infinite;
  bool sound = true;
  for (int rank = 0; rank < coverage.ranks(); ++rank)
  {
    const double share = coverage.share(x, y, rank);
    sum += share;
    sound = sound && share >= 0 && share <= before && coverage.id(x, y, rank) >= 0;
    before = share;
  }
  meter.add(sound ? sum - 1 : Infinite,
    [&]
    {
      return coverage.file().offender(x, y, sound ? "ranks of sum " + numberText(sum) : "a rank of no object or order",
        "falling shares of known objects of sum 1");
    });
}

void checkAlphaPixel(
  const PictureFile& alpha, const Coverage* coverage, std::size_t objects, int x, int y, Meter& meter)
{
  const std::uint32_t id = alpha.id(x, y);
  const double share = alpha.at(x, y, 3) / 255;
  const auto text = [&](double a) { return "object " + std::to_string(id) + ", alpha " + numberText(a); };
  if (id > objects || share == 0)
  {
    meter.equal(false, [&] { return alpha.offender(x, y, text(share), "a known object, alpha above 0"); });
    return;
  }
  const double expected = coverage ? coverage->shareOf(id, x, y) : id == 0 ? 1 : share;
  meter.add(std::max(0.0, std::abs(share - expected) - AlphaRounding),
    [&] { return alpha.offender(x, y, text(share), text(expected)); });
}

/// The samples of coverage a side of a pixel that the request asked for.
int samplesOf(const Manifest& manifest)
{
  for (const auto& [option, value] : manifest.request)
  {
    const int samples = option == "coverage_samples" && value.size() < 4 ? std::atoi(value.c_str()) : 0;
    if (samples > 0)
    {
      return samples;
    }
  }
  return 1;
}

/// Coverage counted anew by rays through the samples.
class SampleCheck
{
public:
  SampleCheck(Picture& picture, const Coverage& coverage)
    : Eyes(picture.sight())
    , Shares(coverage)
    , Samples(samplesOf(picture.dataset().manifest()))
  {
  }

  /// All divided pixels, and some of the others.
  void pixel(int x, int y, Meter& meter) const
  {
    constexpr int step = 4;
    if (this->Shares.share(x, y, 0) == 1 && (x % step != 0 || y % step != 0))
    {
      return;
    }
    std::map<std::uint32_t, int> counts;
    std::map<std::uint32_t, int> doubtful;
    for (int j = 0; j < this->Samples; ++j)
    {
      for (int i = 0; i < this->Samples; ++i)
      {
        const Eigen::Vector2d place(x + (i + 0.5) / this->Samples, y + (j + 0.5) / this->Samples);
        const std::uint32_t first = this->firstAt(place);
        ++counts[first];
        for (const std::uint32_t other : this->firstsAround(place))
        {
          doubtful[other] += other != first;
          doubtful[first] += other != first;
        }
      }
    }
    for (const auto& [id, count] : doubtful)
    {
      counts[id]; // may show as well
    }
    for (const auto& [id, count] : counts)
    {
      this->compare(x, y, id, count, doubtful[id], meter);
    }
  }

private:
  void compare(int x, int y, std::uint32_t id, int count, int doubtful, Meter& meter) const
  {
    const double all = double(this->Samples) * this->Samples;
    const double found = this->Shares.shareOf(id, x, y);
    const double error = std::abs(found - count / all);
    if (error > meter.Tolerance && error <= doubtful / all + meter.Tolerance)
    {
      meter.skip();
      return;
    }
    meter.add(error,
      [&]
      {
        return this->Shares.file().offender(
          x, y, "object " + std::to_string(id) + ", coverage " + numberText(found), numberText(count / all));
      });
  }

  std::uint32_t firstAt(const Eigen::Vector2d& place) const
  {
    std::vector<Hit> hits;
    std::vector<double> depths;
    this->Eyes.surfaces(place, hits, depths);
    return hits.empty() ? 0 : hits.front().object;
  }

  /// Objects that are first within EdgeReach of a sample, each once.
  std::set<std::uint32_t> firstsAround(const Eigen::Vector2d& place) const
  {
    std::set<std::uint32_t> ids;
    for (const Eigen::Vector2d& offset :
      { Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1) })
    {
      ids.insert(this->firstAt(place + EdgeReach * offset));
    }
    return ids;
  }

  const Sight& Eyes;
  const Coverage& Shares;
  int Samples;
};
} // namespace

void checkAlpha(Picture& picture, Results& results)
{
  const PicturePointer file = picture.image("coverage", { ".exr" });
  const std::unique_ptr<Coverage> coverage =
    file && file->channels() % 4 == 0 ? std::make_unique<Coverage>(file, picture.dataset()) : nullptr;
  const auto measure = [&](const char* layer, const auto& pixel)
  {
    results.add(layer, "coverage",
      meterRows(picture.pool(), picture.height(), CoverageTolerance,
        [&](int y, Meter& row)
        {
          for (int x = 0; x < picture.width(); ++x)
          {
            pixel(x, y, row);
          }
        }));
  };
  if (coverage)
  {
    measure("coverage", [&](int x, int y, Meter& row) { checkSums(*coverage, x, y, row); });
    const SampleCheck samples(picture, *coverage);
    measure("samples", [&](int x, int y, Meter& row) { samples.pixel(x, y, row); });
  }
  const PicturePointer alpha = picture.image("alpha", { ".png" });
  if (alpha && alpha->channels() == 4)
  {
    const std::size_t objects = picture.dataset().objects().size();
    measure("alpha", [&](int x, int y, Meter& row) { checkAlphaPixel(*alpha, coverage.get(), objects, x, y, row); });
  }
}

} // namespace dgtk
