// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTarFile.h"

#include "dgtkError.h"

#include <cstdint>
#include <numeric>

namespace dgtk
{

namespace
{
constexpr std::size_t block = 512;

/// A number as octal digits, filled with zeros, and a zero byte.
std::string octal(std::uint64_t number, std::size_t bytes)
{
  std::string digits(bytes, '\0');
  for (std::size_t i = bytes - 1; i-- > 0; number >>= 3)
  {
    digits[i] = static_cast<char>('0' + (number & 7));
  }
  return digits;
}

std::string headerOf(const std::string& name, std::uint64_t size)
{
  std::string head(block, '\0');
  const auto put = [&](std::size_t at, const std::string& text) { head.replace(at, text.size(), text); };
  put(0, name);
  put(100, octal(0644, 8)); // mode
  put(108, octal(0, 8));    // owner
  put(116, octal(0, 8));    // group
  put(124, octal(size, 12));
  put(136, octal(0, 12));        // time
  put(148, std::string(8, ' ')); // the sum is taken with spaces in its place
  put(156, "0");                 // a file
  put(257, std::string("ustar\0", 6) + "00");
  put(329, octal(0, 8)); // device
  put(337, octal(0, 8));
  const auto sum = std::accumulate(head.begin(), head.end(), std::uint64_t(0),
    [](std::uint64_t s, char c) { return s + static_cast<unsigned char>(c); });
  put(148, octal(sum, 7));
  return head;
}
} // namespace

TarFile::TarFile(ExportSink& sink, const std::string& name)
  : File(sink.open(name))
{
}

void TarFile::add(const std::string& name, const std::string& bytes)
{
  constexpr std::uint64_t tooLarge = std::uint64_t(1) << 33;
  if (name.size() > longestName)
  {
    throw UsageError(
      quoted(name) + ": is longer than the " + std::to_string(longestName) + " bytes of a name in a tar");
  }
  if (bytes.size() >= tooLarge)
  {
    throw UsageError(quoted(name) + ": has 8 GiB or more, which a tar cannot say");
  }
  this->File->write(headerOf(name, bytes.size()));
  this->File->write(bytes);
  this->File->write(std::string((block - bytes.size() % block) % block, '\0'));
}

DatasetFile TarFile::finish()
{
  this->File->write(std::string(2 * block, '\0'));
  return this->File->finish();
}

} // namespace dgtk
