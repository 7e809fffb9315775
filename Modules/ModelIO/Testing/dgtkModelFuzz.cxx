// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <new>

#include <malloc.h>

namespace
{
std::atomic<std::size_t> live{ 0 };
std::atomic<std::size_t> peak{ 0 };

void* counted(std::size_t bytes)
{
  void* p = std::malloc(bytes ? bytes : 1);
  if (!p)
  {
    throw std::bad_alloc();
  }
  const std::size_t now = live += ::malloc_usable_size(p);
  peak = now > peak ? now : peak.load();
  return p;
}

void uncounted(void* p) noexcept
{
  live -= p ? ::malloc_usable_size(p) : 0;
  std::free(p);
}
} // namespace

void* operator new(std::size_t bytes) { return counted(bytes); }
void* operator new[](std::size_t bytes) { return counted(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  void* p = std::malloc(bytes ? bytes : 1);
  live += p ? ::malloc_usable_size(p) : 0;
  return p;
}
void operator delete(void* p, const std::nothrow_t&) noexcept { uncounted(p); }
void operator delete(void* p) noexcept { uncounted(p); }
void operator delete[](void* p) noexcept { uncounted(p); }
void operator delete(void* p, std::size_t) noexcept { uncounted(p); }
void operator delete[](void* p, std::size_t) noexcept { uncounted(p); }

namespace dgtk::test
{

std::size_t liveBytes() { return live; }
std::size_t peakBytes() { return peak; }
void resetPeak() { peak = live.load(); }

namespace
{
constexpr std::size_t memoryFactor = 10;
constexpr std::size_t memorySlack = std::size_t(64) << 20;
constexpr double longestSeconds = 2;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double longestOfLarge = 30; ///< files of 256 KiB and more, in a build that is five to fifteen times slower
#else
constexpr double longestOfLarge = longestSeconds;
#endif

/// splitmix64: the same numbers everywhere.
class Dice
{
public:
  explicit Dice(std::uint64_t seed)
    : State(seed)
  {
  }
  std::size_t below(std::size_t limit)
  {
    this->State += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = this->State;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return limit == 0 ? 0 : static_cast<std::size_t>((z ^ (z >> 31)) % limit);
  }

private:
  std::uint64_t State;
};

const std::string binaryValues[] = { std::string(4, '\0'), "\xff\xff\xff\xff", "\xff\xff\xff\x7f",
  std::string("\0\0\0\x80", 4), std::string("\0\0\xc0\x7f", 4), std::string("\0\0\x80\x7f", 4),
  std::string("\x01\0\0\0", 4), std::string("\0\0\x01\0", 4), std::string("\xff\xff", 2) };
const std::string textValues[] = { "-1", "0", "999999999", "99999999999999999999", "nan", "-inf", "1e400", "1e38",
  "1e-400", "x", "\"", "{", "}", "<", ">", ",", "\n", "\r", "\xff", "0x", "//", "/*" };

/// Replaces the number or word at a place.
void replaceWord(std::string& text, std::size_t at, const std::string& by)
{
  const std::size_t begin = text.find_first_not_of(" \n\r\t", at);
  if (begin != std::string::npos)
  {
    const std::size_t end = text.find_first_of(" \n\r\t,<>", begin + 1);
    text.replace(begin, (end == std::string::npos ? text.size() : end) - begin, by);
  }
}

void mutateOnce(std::string& bytes, Dice& dice)
{
  const std::size_t at = dice.below(bytes.size());
  const std::size_t length = 1 + dice.below(dice.below(4) == 0 ? 64 : 8);
  switch (dice.below(8))
  {
    case 0:
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1u << dice.below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(dice.below(256));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(dice.below(bytes.size()), length));
      break;
    case 4:
    {
      const std::string& value = binaryValues[dice.below(std::size(binaryValues))];
      // half of them where 4-byte values lie
      const std::size_t place = dice.below(2) ? at / 4 * 4 : at;
      bytes.replace(place, std::min(value.size(), bytes.size() - place), value);
      break;
    }
    case 5:
      bytes.insert(at, textValues[dice.below(std::size(textValues))]);
      break;
    case 6:
      replaceWord(bytes, at, textValues[dice.below(std::size(textValues))]);
      break;
    default:
      std::swap(bytes[at], bytes[dice.below(bytes.size())]);
  }
}

/// Of this process; other programs on the machine do not count.
double processorSeconds()
{
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Outcome
{
  std::shared_ptr<const Model> model;
  bool refused = false;
  std::size_t triangles = 0;
  bool warned = false;
  double seconds = 0;
  std::size_t bytes = 0; ///< at most in use
};

/// `keep`: the outcome keeps the model.
Outcome readOnce(const std::string& path, const std::string& bytes, const std::string& what, bool keep = false)
{
  writeFile(path, bytes);
  ReadOptions options;
  options.decodeTextures = false;
  Outcome outcome;
  const std::size_t before = liveBytes();
  resetPeak();
  const double start = processorSeconds();
  try
  {
    const std::shared_ptr<const Model> model = readModel(path, options);
    outcome.model = keep ? model : nullptr;
    outcome.bytes = peakBytes() - before;
    outcome.seconds = processorSeconds() - start;
    outcome.triangles = model->triangles.size();
    outcome.warned = !model->warnings.empty();
    EXPECT_EQ(brokenPromise(*model), "") << what;
  }
  catch (const InputError& error)
  {
    outcome.refused = true;
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << what << ": " << text;
    EXPECT_NE(text.find(path), std::string::npos) << what << ": " << text;
  }
  catch (const std::exception& error)
  {
    ADD_FAILURE() << what << ": " << error.what();
  }
  if (outcome.bytes == 0)
  {
    outcome.bytes = peakBytes() - before;
    outcome.seconds = processorSeconds() - start;
  }
  EXPECT_LT(outcome.seconds, bytes.size() > (std::size_t(1) << 18) ? longestOfLarge : longestSeconds) << what;
  EXPECT_LT(outcome.bytes, memoryFactor * bytes.size() + memorySlack) << what;
  return outcome;
}
} // namespace

namespace
{
std::string damagedBy(Dice& dice, const std::string& seed, bool truncated)
{
  std::string bytes = seed;
  if (truncated)
  {
    bytes.resize(dice.below(bytes.size()));
    return bytes;
  }
  const std::size_t changes = 1 + dice.below(4);
  for (std::size_t c = 0; c < changes && !bytes.empty(); ++c)
  {
    mutateOnce(bytes, dice);
  }
  return bytes;
}
} // namespace

std::string damaged(const std::string& seed, std::uint64_t variant)
{
  Dice dice(variant);
  return damagedBy(dice, seed, variant % 4 == 0);
}

std::shared_ptr<const Model> readWithinLimits(const std::string& extension, const std::string& bytes)
{
  const TemporaryFolder folder;
  const Outcome outcome = readOnce(folder.path("limits." + extension), bytes, extension, true);
  std::cout << extension << ": " << bytes.size() / 1024 << " KiB read in " << outcome.seconds << " s and "
            << outcome.bytes / 1024 << " KiB, " << double(outcome.bytes) / double(bytes.size()) << " times the file; "
            << (outcome.refused ? "refused" : std::to_string(outcome.triangles) + " triangles") << '\n';
  return outcome.model;
}

bool sweepsAreWhole()
{
  const char* const whole = std::getenv("DGTK_TEST_WHOLE");
  return whole && *whole;
}

void fuzzReader(const std::string& extension, const std::vector<std::string>& seeds, int variants, bool knowsItsEnd)
{
  variants /= sweepsAreWhole() ? 1 : 4;
  const TemporaryFolder folder;
  const std::string path = folder.path("fuzz." + extension);
  const int perSeed = variants / static_cast<int>(seeds.size()) + 1;
  int refused = 0;
  int read = 0;
  for (std::size_t s = 0; s < seeds.size(); ++s)
  {
    const Outcome whole = readOnce(path, seeds[s], "seed " + std::to_string(s));
    ASSERT_FALSE(whole.refused) << "seed " << s;
    Dice dice(1000 * s + 1);
    for (int i = 0; i < perSeed && !testing::Test::HasFailure(); ++i)
    {
      const bool truncated = i % 4 == 0;
      const std::string bytes = damagedBy(dice, seeds[s], truncated);
      const std::string what = "seed " + std::to_string(s) + ", variant " + std::to_string(i);
      const Outcome outcome = readOnce(path, bytes, what);
      EXPECT_TRUE(
        !truncated || !knowsItsEnd || outcome.refused || outcome.warned || outcome.triangles == whole.triangles)
        << what << ": a part of a truncated file without a warning";
      ++(outcome.refused ? refused : read);
      if (testing::Test::HasFailure())
      {
        writeFile("fuzz-failure." + extension, bytes);
      }
    }
  }
  testing::Test::RecordProperty("refused", refused);
  testing::Test::RecordProperty("read", read);
  EXPECT_GE(refused + read, variants);
  EXPECT_GT(refused, 0);
  EXPECT_GT(read, 0);
}

} // namespace dgtk::test
