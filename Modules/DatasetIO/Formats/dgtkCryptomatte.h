// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCryptomatte_h
#define dgtkCryptomatte_h

#include "dgtkDatasetIOModule.h"

#include "dgtkLayerWriter.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// Cryptomatte 1.2 (Friedman and Jones): coverage of every object of a pixel in an OpenEXR file. Channels
// CryptoObject00.r, .g, .b, .a, CryptoObject01.r, ...: r and b are ids, g and a the coverages of ranks 0, 1, 2, ...

namespace dgtk
{

/// MurmurHash3_x86_32 of Appleby with seed 0.
DGTKDATASETIO_EXPORT std::uint32_t murmurHash3(const void* data, std::size_t bytes);

/// The bits of the id of a name: its hash, with bit 23 flipped where it would be a denormal, an infinity or no number
/// ("uint32_to_float32").
DGTKDATASETIO_EXPORT std::uint32_t cryptomatteHash(const std::string& name);
/// The same bits as float32: the id as it stands in the pixels.
DGTKDATASETIO_EXPORT float cryptomatteId(const std::string& name);

/// Names that differ: a name that is empty or stood before gets '#' and its place, from 1, behind it.
DGTKDATASETIO_EXPORT std::vector<std::string> distinctNames(const std::vector<std::string>& names);

/// An object and the share of a pixel that it covers.
struct CoveredId
{
  std::uint32_t id = 0; ///< 0: background, written as id 0.0
  float coverage = 0;   ///< (0, 1]
};

/// Collects pixels, row by row from the top, and writes them on finish(), when it is known how many ranks they need.
/// Memory grows with the pixels that several objects share.
class DGTKDATASETIO_EXPORT CryptomatteWriter
{
public:
  /// `names[id - 1]` is the name of an object. `leastRanks`: channels for so many are written anyway. Throws what
  /// makeLayerWriter() throws.
  CryptomatteWriter(const FilePlace& path, const LayerSpec& spec, int width, int height,
    const std::vector<std::string>& names, int leastRanks);
  ~CryptomatteWriter();

  /// The next `pixels` pixels, all with these ranks, the largest coverage first.
  void add(const std::vector<CoveredId>& ranks, std::uint32_t pixels);
  /// Throws UsageError unless exactly width x height pixels were added, MachineError when the file cannot be written.
  FileRecord finish();

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
