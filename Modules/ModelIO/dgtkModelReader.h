// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelReader_h
#define dgtkModelReader_h

#include "dgtkModel.h"
#include "dgtkModelCache.h"

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

class TextureStore;

struct ReadOptions
{
  bool decodeTextures = true;             ///< false: textures are located, not decoded (Texture::image stays null)
  std::shared_ptr<TextureStore> textures; ///< all pictures of the scene; null: the model has its own
  std::shared_ptr<ModelCache> cache = ModelCache::inUse(); ///< models that were read before; null: none
  std::string sceneFolder; ///< the folder of the scene that the model is read for, whose pictures it may name; or ""
};

/// Reads a model with the reader of its extension (case-insensitive). Throws InputError: no such file, an unknown
/// extension (the known ones are named), contents that cannot be used, a file named that is not the model's. What is
/// opened: the file; what it includes or names in its folder or below; pictures in the folder above it and below, or in
/// the scene's folder. Memory stays below 10 times the file's bytes plus 64 MiB, textures apart. Throws MachineError
/// when memory is short, or the pictures exceed the budget.
DGTKMODELIO_EXPORT std::shared_ptr<const Model> readModel(const std::string& path, const ReadOptions& options = {});

} // namespace dgtk

#endif
