// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkInputFile_h
#define dgtkInputFile_h

#include "dgtkLayerReader.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

namespace dgtk
{

/// As many bytes a byte of a deflated stream can hold.
inline constexpr std::uint64_t deflateRatio = 1032;

/// A regular file that is read at offsets. Every failure is an InputError that names the file and the offset.
class InputFile
{
public:
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return this->Path; }
  std::uint64_t size() const { return this->Size; }
  void read(std::uint64_t offset, void* to, std::size_t bytes) const;
  /// The first bytes, at most `bytes`.
  std::string head(std::size_t bytes) const;
  template <typename T>
  T value(std::uint64_t offset) const
  {
    T out;
    this->read(offset, &out, sizeof out);
    return out;
  }
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what, const std::string& expected = {},
    const std::string& found = {}) const;

private:
  std::string Path;
  std::uint64_t Size = 0;
  int Descriptor;
};

/// Largest width and height of an image that is read.
constexpr std::int64_t largestImageSide = std::int64_t(1) << 24;

/// Checks a size found at `offset` of a header. Throws InputError.
void checkImageSize(const InputFile& file, std::uint64_t offset, std::int64_t width, std::int64_t height);

using RowReaderFactory = std::unique_ptr<RowReader> (*)(const std::string& path, DepthMatrices* matrices);

/// Formats whose pixels stand in the file as they are: npy, ppm (and pgm), pfm, dgd, flo.
RowReaderFactory plainReader(const std::string& extension);
std::unique_ptr<RowReader> openPngReader(const std::string& path);
std::unique_ptr<RowReader> openExrReader(const std::string& path);

} // namespace dgtk

#endif
