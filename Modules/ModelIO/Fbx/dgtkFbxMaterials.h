// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxMaterials_h
#define dgtkFbxMaterials_h

#include "dgtkAssimpStream.h"
#include "dgtkFbxScene.h"

#include <map>

namespace dgtk::import
{

/// How a material's picture lies on a surface: texture coordinates of the mesh are multiplied by this 2 x 3 matrix.
struct FbxPlacement
{
  std::string uvSet;
  std::array<double, 6> picture_from_uv{ 1, 0, 0, 0, 1, 0 };
};

/// Materials of a file, each made once.
class FbxMaterials
{
public:
  FbxMaterials(const FbxScene& scene, Scene& to)
    : File(scene)
    , To(to)
  {
  }

  /// Index of the scene's material that an object is.
  std::int32_t indexOf(std::size_t object);
  /// A grey one, for surfaces without one.
  std::int32_t other();
  const FbxPlacement& placement(std::int32_t material) const
  {
    return this->Placements[static_cast<std::size_t>(material)];
  }

private:
  std::size_t textureOf(const FbxObject& material, const char* property) const;
  void readPictures(const FbxObject& material, Material& to, FbxPlacement& placement);
  std::string pictureOf(std::size_t texture);
  std::string embedded(const FbxElement& video, const std::string& name);

  const FbxScene& File;
  Scene& To;
  std::vector<FbxPlacement> Placements;
  std::map<std::size_t, std::int32_t> Made; ///< by object; 0, which is no material, for the grey one
  std::map<const FbxElement*, std::string> Embedded;
};

} // namespace dgtk::import

#endif
