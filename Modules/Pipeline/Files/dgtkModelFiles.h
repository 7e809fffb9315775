// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelFiles_h
#define dgtkModelFiles_h

// Private to Pipeline.

#include "dgtkStage.h"

#include "dgtkRunFiles.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// The geometries of a scene as files of a dataset: models/<16 digits of the hash>.ply, each once, with the textures
/// that its materials show beside it.
class ModelFiles
{
public:
  /// `geometry`: geometryHashes() of the stage.
  ModelFiles(const Stage& stage, const std::vector<std::string>& geometry);

  /// Relative to the dataset.
  std::vector<std::string> names() const;
  /// The file of a hash.
  static std::string nameOf(const std::string& geometry);
  /// Writes what an interrupted run has not. Throws InputError for a texture's file that cannot be read.
  void write(const std::string& folder, RunFiles& run) const;

private:
  struct File
  {
    std::size_t object = 0;                         ///< index of the first instance that has this geometry
    std::map<const Texture*, std::string> pictures; ///< names, relative to the dataset
    std::vector<const Texture*> order;              ///< as the parts use them
  };
  File fileOf(std::size_t object, const std::string& name) const;
  std::string ply(const File& file) const;

  std::shared_ptr<const SceneState> State; ///< at the scene's first frame
  std::map<std::string, File> Files;       ///< by name
};

} // namespace dgtk

#endif
