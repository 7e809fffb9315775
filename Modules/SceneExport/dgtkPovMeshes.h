// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovMeshes_h
#define dgtkPovMeshes_h

#include "dgtkPovExport.h"
#include "dgtkPovImages.h"
#include "dgtkPovMaterials.h"
#include "dgtkPovText.h"
#include "dgtkPovTurned.h"

#include <map>
#include <tuple>
#include <vector>

namespace dgtk
{

/// The materials of an instance: its own or its model's.
const std::vector<Material>& povMaterialsOf(const Instance& instance);

/// Id that a mesh of its own must know for its textures, or 0 when a mesh serves all objects.
std::uint32_t povOwnId(const Instance& instance, std::uint32_t id, const PovSurfaceOptions& options);

/// Which texture of its list each triangle of a mesh has.
struct PovTextures
{
  std::vector<std::string> list;           ///< `texture { ... }`
  std::vector<int> ofMaterial;             ///< material -> index of the list; empty without textures of its own
  std::map<std::uint32_t, int> ofTriangle; ///< triangles that have another than their material's
};

/// Those of the materials in use.
PovTextures povTexturesOf(
  const Instance& instance, std::uint32_t ownId, const PovSurfaceOptions& options, PovImages& images);

/// `mesh2 { ... }` without its beginning: `{`, lists, `}`.
void povWriteMesh(PovText& text, const Instance& instance, const PovTextures& textures);

/// Where meshes are declared.
class PovMeshes
{
public:
  virtual ~PovMeshes() = default;
  /// The name of an instance's mesh, which is declared unless it was. With triangles that are shaded as the view sees
  /// them it is the object's own.
  virtual std::string declare(const Instance& instance, std::uint32_t id, const PovTurned& turned) = 0;
};

/// In the scene itself.
class PovMeshesInside final : public PovMeshes
{
public:
  PovMeshesInside(PovText& text, PovImages& images, const PovSurfaceOptions& options)
    : Text(text)
    , Images(images)
    , Options(options)
  {
  }
  std::string declare(const Instance& instance, std::uint32_t id, const PovTurned& turned) override;

private:
  using Key = std::tuple<const Model*, const Geometry*, const std::vector<Material>*, std::uint32_t, double>;

  std::string nextName() { return "Mesh" + std::to_string(++this->Declared); }

  PovText& Text;
  PovImages& Images;
  PovSurfaceOptions Options;
  std::map<Key, std::string> Names;
  std::size_t Declared = 0;
};

/// `object { ... }` of each instance.
class PovObjects
{
public:
  PovObjects(PovText& text, PovMeshes& meshes, const View& view, const PovSurfaceOptions& options, double scale)
    : Text(text)
    , Meshes(meshes)
    , TheView(view)
    , Options(options)
    , Scale(scale)
  {
  }
  /// `shared`: other objects have the same mesh.
  void add(const Instance& instance, std::uint32_t id, bool shared);

private:
  std::string clipping(const Instance& instance) const;
  PovTurned turned(const Instance& instance, bool shared) const;
  std::string texture(std::uint32_t id) const;

  PovText& Text;
  PovMeshes& Meshes;
  const View& TheView;
  PovSurfaceOptions Options;
  double Scale;
};

} // namespace dgtk

#endif
