// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovMeshes_h
#define dgtkPovMeshes_h

// Private to Export.

#include "dgtkPovExport.h"
#include "dgtkPovImages.h"
#include "dgtkPovMaterials.h"
#include "dgtkPovText.h"

#include <map>
#include <tuple>

namespace dgtk
{

/// The materials of an instance: its own or its model's.
const std::vector<Material>& povMaterialsOf(const Instance& instance);

/// Id that a mesh of its own must know for its textures, or 0 when a mesh serves all objects.
std::uint32_t povOwnId(const Instance& instance, std::uint32_t id, const PovSurfaceOptions& options);

/// `mesh2 { ... }` without its end: `{`, lists, `}`.
void povWriteMesh(
  PovText& text, const Instance& instance, std::uint32_t ownId, const PovSurfaceOptions& options, PovImages& images);

/// Where meshes are declared.
class PovMeshes
{
public:
  virtual ~PovMeshes() = default;
  /// The name of an instance's mesh, which is declared unless it was.
  virtual std::string declare(const Instance& instance, std::uint32_t id) = 0;
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
  std::string declare(const Instance& instance, std::uint32_t id) override;

private:
  using Key = std::tuple<const Model*, const Geometry*, const std::vector<Material>*, std::uint32_t, double>;

  PovText& Text;
  PovImages& Images;
  PovSurfaceOptions Options;
  std::map<Key, std::string> Names;
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
  void add(const Instance& instance, std::uint32_t id);

private:
  std::string clipping(const Instance& instance) const;
  std::string texture(std::uint32_t id) const;

  PovText& Text;
  PovMeshes& Meshes;
  const View& TheView;
  PovSurfaceOptions Options;
  double Scale;
};

} // namespace dgtk

#endif
