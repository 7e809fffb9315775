// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDeepExrFile_h
#define dgtkDeepExrFile_h

#include "dgtkLdi.h"

#include <memory>
#include <string>

namespace dgtk
{

/// A deep OpenEXR file that is being written; of the library dgtkdeepexr.
class DeepExrFile
{
public:
  virtual ~DeepExrFile() = default;
  virtual bool opened() const = 0;
  /// The next rows, at least one pixel; colours in linear light.
  virtual bool write(const LdiRows& rows) = 0;
  virtual bool close() = 0;
  /// Why one of these failed.
  virtual std::string error() const = 0;
};

/// The library dgtkdeepexr is loaded when a deep file is written: see dgtkOnDemand.h.
struct DeepExrCalls
{
  std::unique_ptr<DeepExrFile> (*make)(const std::string& path, int width, int height); ///< never null
};

} // namespace dgtk

extern "C" const dgtk::DeepExrCalls* dgtkdeepexrCalls();

#endif
