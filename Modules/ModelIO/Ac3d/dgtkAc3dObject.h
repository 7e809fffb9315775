// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAc3dObject_h
#define dgtkAc3dObject_h

#include "dgtkAc3dLines.h"
#include "dgtkModelBuilder.h"
#include "dgtkRigid3.h"

#include <string>
#include <vector>

namespace dgtk
{

/// The geometry of an AC3D file, one OBJECT after another: vertices, surfaces, lines and how they are textured.
class Ac3dObject
{
public:
  /// `materials`: the file's materials as indices of the builder's.
  Ac3dObject(Ac3dLines& lines, ModelBuilder& builder, const std::vector<int>& materials)
    : Lines(lines)
    , Builder(builder)
    , Materials(materials)
  {
  }
  /// Starts an OBJECT below `root_from_parent`; it has its parent's texture until it names one.
  void begin(const Affine3& root_from_parent, const std::string& texture);
  /// One statement of the object; `words` is its line.
  void statement(const Words& words);
  void end();
  /// Warns of what was found in all objects.
  void report();

  Affine3 rootFromObject() const { return this->Root_from_parent * this->Parent_from_object; }
  const std::string& texture() const { return this->Texture; }
  /// Of the number that the object announced; below 0 where it has more.
  long long surfacesLeft() const { return this->SurfacesLeft; }

private:
  void textureStatement(const Words& words);
  void vertices(long long number);
  void refs(long long number);
  Corner corner(const Words& words);
  SurfaceStyle style();
  void line(bool closed);
  void strip();

  Ac3dLines& Lines;
  ModelBuilder& Builder;
  const std::vector<int>& Materials;

  Affine3 Root_from_parent;
  Affine3 Parent_from_object;
  std::string Texture;
  Eigen::Vector2d Repeat{ 1, 1 };
  Eigen::Vector2d Offset{ 0, 0 };
  std::uint32_t FirstVertex = 0;
  std::uint32_t Vertices = 0;
  std::vector<std::int32_t> Normals; ///< of each vertex, where the file has them
  unsigned Flags = 0;                ///< of the surface being read
  long long SurfaceMaterial = -1;
  long long SurfacesLeft = 0;
  std::vector<Corner> Corners;

  std::size_t BadMaterials = 0;
  std::size_t UnknownSurfaces = 0;
};

} // namespace dgtk

#endif
