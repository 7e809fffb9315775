// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStageModels_h
#define dgtkStageModels_h

#include "dgtkMaterialNumbers.h"
#include "dgtkModelReader.h"
#include "dgtkModelSource.h"
#include "dgtkPathNames.h"
#include "dgtkStage.h"
#include "dgtkTextureFile.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// A picture that a scene gives to materials, by its name or path.
using ScenePicture = std::pair<std::string, TextureUse>;

/// What was read for a scene, for those that are like it.
struct ReadFiles
{
  struct File
  {
    std::shared_ptr<const Model> model;
    std::size_t ownTextures = 0;        ///< the others are the scene's:
    std::vector<ScenePicture> pictures; ///< as written
  };
  std::map<std::string, File> models; ///< by PathNames::of(), as the other paths
  std::string folder;                 ///< where the scene's paths start
  std::string environment;            ///< its picture's path
  std::shared_ptr<const RadianceImage> light;
  std::map<ScenePicture, std::shared_ptr<const Image>> images; ///< by their paths
};

/// Adds the pictures that an object gives to materials of its model, as written, unless they are listed.
void addPictures(const ObjectDescription& object, std::vector<ScenePicture>& listed);

/// Everything that the objects of a scene need from files, each file read once.
class StageModels : public ModelSource
{
public:
  /// Throws InputError with the scene's file and the line of the object that wants the model.
  /// What is among the known files is not read again.
  StageModels(const SceneDescription& scene, const Stage::WarningSink& warning, const ReadFiles& known = {});

  /// Of this scene and its objects only.
  ObjectLook lookOf(const SceneDescription& scene, const ObjectDescription& object) const override;
  std::shared_ptr<const EnvironmentState> environment(const SceneDescription&) const override
  {
    return this->Environment;
  }
  std::shared_ptr<GeometryCache> geometries() const override { return this->Geometries; }

  const std::vector<std::shared_ptr<const Model>>& models() const { return this->Models; }
  std::vector<std::string> files() const override { return this->Files; }
  const ReadFiles& read() const { return this->Read; }

private:
  const std::shared_ptr<const Model>& modelOf(std::size_t object) const { return this->Models[this->Uses[object]]; }
  void requireUnread();
  void readModels();
  void countPictures(const Model& model, std::size_t textures);
  void listPictures();
  void addTextures();
  bool hasPictures(const std::string& place, const ReadFiles::File& file) const;
  std::shared_ptr<const Model> withPictures(const ReadFiles::File& file);
  Texture makeTexture(const ScenePicture& written);
  MaterialList makeMaterials(std::size_t object) const;
  void applySkin(const ObjectDescription& object, const Model& model, std::vector<Material>& materials) const;
  void applyOverride(const ObjectDescription& object, const Model& model, const MaterialOverride& change,
    std::vector<Material>& materials) const;
  int textureOf(const Model& model, const ScenePicture& written) const;
  void readEnvironment();
  void addFile(const std::string& path);
  void warn(const std::string& line) const;

  const SceneDescription& Scene;
  const Stage::WarningSink& Warning;
  const ReadFiles Known;
  ReadFiles Read;
  PathNames Names;
  std::shared_ptr<TextureStore> Pictures; ///< all of the scene
  std::set<const Image*> Counted;         ///< those of known models
  std::vector<std::shared_ptr<const Model>> Models;
  std::vector<std::string> Places; ///< of the models: PathNames::of()
  std::vector<std::size_t> Uses;   ///< object -> model
  std::vector<MaterialList> Materials;
  std::shared_ptr<const EnvironmentState> Environment;
  std::shared_ptr<GeometryCache> Geometries = std::make_shared<GeometryCache>();
  std::map<std::pair<const Model*, ScenePicture>, int> Textures; ///< texture of the scene -> index in the model
  std::vector<std::string> Files;
};

/// Throws InputError at an object: FILE:LINE: object 'name': what.
[[noreturn]] void failObject(const SceneDescription& scene, const ObjectDescription& object, const std::string& what,
  const std::string& expected = {}, const std::string& found = {});

} // namespace dgtk

#endif
