// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCryptomatte.h"

#include "dgtkError.h"
#include "dgtkJsonText.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <set>

namespace dgtk
{

namespace
{
const char* const layerName = "CryptoObject";
constexpr int blockRows = 64;

std::uint32_t rotated(std::uint32_t value, int bits) { return (value << bits) | (value >> (32 - bits)); }

std::uint32_t scrambled(std::uint32_t block) { return rotated(block * 0xcc9e2d51u, 15) * 0x1b873593u; }

std::string hexadecimal(std::uint32_t value)
{
  char text[9];
  std::snprintf(text, sizeof text, "%08x", value);
  return text;
}
} // namespace

std::uint32_t murmurHash3(const void* data, std::size_t bytes)
{
  const auto* at = static_cast<const unsigned char*>(data);
  std::uint32_t hash = 0;
  std::size_t left = bytes;
  const auto little = [&](std::size_t count)
  {
    std::uint32_t block = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      block |= std::uint32_t(at[i]) << (8 * i);
    }
    return block;
  };
  for (; left >= 4; left -= 4, at += 4)
  {
    hash = rotated(hash ^ scrambled(little(4)), 13) * 5 + 0xe6546b64u;
  }
  hash ^= scrambled(little(left));
  hash ^= static_cast<std::uint32_t>(bytes);
  hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
  hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
  return hash ^ (hash >> 16);
}

std::uint32_t cryptomatteHash(const std::string& name)
{
  const std::uint32_t hash = murmurHash3(name.data(), name.size());
  const std::uint32_t exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ (1u << 23) : hash;
}

float cryptomatteId(const std::string& name)
{
  const std::uint32_t bits = cryptomatteHash(name);
  float id;
  std::memcpy(&id, &bits, sizeof id);
  return id;
}

std::vector<std::string> distinctNames(const std::vector<std::string>& names)
{
  std::set<std::string> taken(names.begin(), names.end());
  std::set<std::string> seen;
  std::vector<std::string> distinct;
  for (const std::string& name : names)
  {
    std::string own = name;
    if (name.empty() || seen.count(name) > 0)
    {
      own = name + '#' + std::to_string(distinct.size() + 1);
      while (!taken.insert(own).second)
      {
        own += '#';
      }
    }
    seen.insert(own);
    distinct.push_back(own);
  }
  return distinct;
}

struct CryptomatteWriter::Impl
{
  struct Run
  {
    std::size_t first; ///< index into Entries
    std::uint32_t ranks;
    std::uint32_t pixels;
  };

  FilePlace Place;
  LayerSpec Spec;
  int Width;
  int Height;
  std::size_t Ranks;
  std::vector<std::string> Names;
  std::vector<float> Ids; ///< by object id
  std::vector<Run> Runs;
  std::vector<CoveredId> Entries;
  std::uint64_t Pixels = 0;

  LayerWriterContext context() const
  {
    LayerWriterContext context;
    for (std::size_t level = 0; level * 2 < this->Ranks; ++level)
    {
      char name[32];
      for (const char channel : { 'r', 'g', 'b', 'a' })
      {
        std::snprintf(name, sizeof name, "%s%02d.%c", layerName, static_cast<int>(level), channel);
        context.channels.emplace_back(name);
      }
    }
    std::string manifest;
    for (const std::string& name : this->Names)
    {
      manifest += (manifest.empty() ? "{" : ",") + jsonString(name) + ":\"" + hexadecimal(cryptomatteHash(name)) + '"';
    }
    const std::string prefix = "cryptomatte/" + hexadecimal(cryptomatteHash(layerName)).substr(0, 7) + '/';
    context.attributes = { { prefix + "conversion", "uint32_to_float32" }, { prefix + "hash", "MurmurHash3_32" },
      { prefix + "manifest", manifest.empty() ? "{}" : manifest + '}' }, { prefix + "name", layerName } };
    return context;
  }

  void fill(float* to, const Run& run) const
  {
    const std::size_t channels = this->Ranks * 2;
    std::fill(to, to + channels, 0.0f);
    for (std::size_t r = 0; r < run.ranks; ++r)
    {
      const CoveredId& entry = this->Entries[run.first + r];
      to[2 * r] = this->Ids[entry.id];
      to[2 * r + 1] = entry.coverage;
    }
    for (std::size_t i = 1; i < run.pixels; ++i)
    {
      std::memcpy(to + i * channels, to, channels * sizeof(float));
    }
  }
};

CryptomatteWriter::CryptomatteWriter(const FilePlace& path, const LayerSpec& spec, int width, int height,
  const std::vector<std::string>& names, int leastRanks)
  : Self(new Impl{ path, spec, width, height, std::size_t(leastRanks), distinctNames(names), { 0.0f }, {}, {}, 0 })
{
  for (const std::string& name : this->Self->Names)
  {
    this->Self->Ids.push_back(cryptomatteId(name));
  }
}

CryptomatteWriter::~CryptomatteWriter() = default;

void CryptomatteWriter::add(const std::vector<CoveredId>& ranks, std::uint32_t pixels)
{
  Impl& self = *this->Self;
  self.Ranks = std::max(self.Ranks, ranks.size());
  // runs end with their row
  while (pixels > 0)
  {
    const auto left = static_cast<std::uint32_t>(self.Width - self.Pixels % self.Width);
    const std::uint32_t now = std::min(pixels, left);
    self.Runs.push_back({ self.Entries.size(), static_cast<std::uint32_t>(ranks.size()), now });
    self.Entries.insert(self.Entries.end(), ranks.begin(), ranks.end());
    self.Pixels += now;
    pixels -= now;
  }
}

FileRecord CryptomatteWriter::finish()
{
  Impl& self = *this->Self;
  if (self.Pixels != std::uint64_t(self.Width) * self.Height)
  {
    throw UsageError(self.Place.path() + ": " + std::to_string(self.Pixels) + " pixels were written (expected " +
                     std::to_string(self.Width) + " x " + std::to_string(self.Height) + ')');
  }
  self.Ranks += self.Ranks % 2;
  self.Spec.channels = static_cast<int>(self.Ranks * 2);
  const std::unique_ptr<LayerWriter> writer =
    makeLayerWriter("exr", self.Place, self.Spec, self.Width, self.Height, self.context());
  std::size_t next = 0;
  for (int y = 0; y < self.Height; y += blockRows)
  {
    Rows rows(PixelType::Float32, self.Spec.channels, self.Width, y, std::min(blockRows, self.Height - y));
    float* to = rows.row<float>(y);
    const float* const end = to + std::size_t(self.Width) * rows.height() * self.Spec.channels;
    for (; to < end; ++next)
    {
      self.fill(to, self.Runs[next]);
      to += std::size_t(self.Runs[next].pixels) * self.Spec.channels;
    }
    writer->write(rows);
  }
  return writer->finish();
}

} // namespace dgtk
