// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWriterEntry_h
#define dgtkWriterEntry_h

#include "dgtkLayerWriter.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// What the file of a format defines: `const WriterEntry writer<Name>`.
struct WriterEntry
{
  bool (*canWrite)(const LayerSpec& spec);
  /// Called with a size of at least 1 x 1 and a specification that canWrite() accepts.
  std::unique_ptr<LayerWriter> (*open)(
    const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext& context);
  bool rounds = false;                  ///< float64 to float32
  std::uint32_t largestId = 0xffffffff; ///< of a uint32 layer
  bool marksNothing = false;            ///< it gives up its largest id where a layer's code for nothing does not fit
  bool matrices = false;                ///< it stores those of OpenGL
};

struct WriterRow
{
  WriterInfo info;
  const WriterEntry* entry;
};

DGTKDATASETIO_EXPORT const std::vector<WriterRow>& writerRows();

/// Adds a format of a program of its own, before anything asks for formats. `entry` lives as long as the program. True.
DGTKDATASETIO_EXPORT bool addWriter(const WriterInfo& info, const WriterEntry& entry);

} // namespace dgtk

#endif
