// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerFile_h
#define dgtkLayerFile_h

#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkLayerWriter.h"

#include <cstring>
#include <string>
#include <vector>

namespace dgtk
{

/// What every writer shares: the checks on the rows, the file and its hash. A format implements writeRows() and, when
/// something follows the pixels, complete().
class DGTKDATASETIO_EXPORT LayerFileWriter : public LayerWriter
{
public:
  LayerFileWriter(const FilePlace& path, const LayerSpec& spec, int width, int height);
  void write(const Rows& rows) final;
  FileRecord finish() final;

protected:
  virtual void writeRows(const Rows& rows) = 0;
  virtual void complete() {}

  /// Appends to the file; hashed as it is written.
  void append(const void* data, std::size_t bytes);
  void append(const std::string& text) { this->append(text.data(), text.size()); }
  /// Writes anywhere in the file. Once used, the hash is taken from the finished file instead.
  void writeAt(std::uint64_t offset, const void* data, std::size_t bytes);
  /// Says that writeAt() will be used, so that nothing is hashed twice.
  void hashAtEnd() { this->Sequential = false; }

  const LayerSpec Spec;
  const int Width;
  const int Height;

private:
  void check(const Rows& rows) const;
  std::string Path;
  AtomicFile File;
  Sha256 Hash;
  std::uint64_t Bytes = 0;
  bool Sequential = true;
  bool Finished = false;
  int NextRow = 0;
};

/// NPY format 1.0: magic, version, header length, a Python dictionary padded so that the data start at a multiple
/// of 64. `shape` as it stands in its parentheses: "480, 640".
DGTKDATASETIO_EXPORT std::string npyHeader(PixelType type, const std::string& shape);

/// Little-endian bytes, whatever the machine.
template <typename T>
void putLittle(std::string& to, T value)
{
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#error "pixels are written in the machine's byte order, which has to be little-endian"
#endif
  to.append(bytes, sizeof(T));
}

/// Big-endian 16 bits, as in PNG and PPM.
inline void putBig16(unsigned char* to, unsigned int value)
{
  to[0] = static_cast<unsigned char>(value >> 8);
  to[1] = static_cast<unsigned char>(value);
}

/// Throws a UsageError that names the first value above `largest`.
[[noreturn]] DGTKDATASETIO_EXPORT void refuseIds(
  const std::uint32_t* ids, std::size_t count, std::uint32_t largest, const char* container, const std::string& layer);

/// Values of a Float32 or Float64 block as float32; float64 is rounded to nearest.
DGTKDATASETIO_EXPORT void narrow(const Rows& rows, std::vector<float>& out);

} // namespace dgtk

#endif
