// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelReader_h
#define dgtkModelReader_h

#include "dgtkModel.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// One row of the registry of readers.
struct ReaderInfo
{
  std::string name;                    ///< "Ac3d"
  std::string format;                  ///< value of Model::format
  std::string description;             ///< "AC3D"
  std::vector<std::string> extensions; ///< lower case, no dot
};

/// All readers, in the order of their rows in CMakeLists.txt.
DGTKMODELIO_EXPORT const std::vector<ReaderInfo>& modelReaders();

struct ReadOptions
{
  bool decodeTextures = true; ///< false: textures are located, not decoded (Texture::image stays null)
};

/// Reads a model with the reader of its extension (case-insensitive). Throws InputError: no such file, an unknown
/// extension (the known ones are named), contents that cannot be used. Nothing but the file, and what it includes or
/// names beside it, is opened. Memory stays below 10 times the file's bytes plus 64 MiB, textures apart.
DGTKMODELIO_EXPORT std::shared_ptr<const Model> readModel(const std::string& path, const ReadOptions& options = {});

} // namespace dgtk

#endif
