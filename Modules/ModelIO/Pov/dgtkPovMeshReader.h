// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovMeshes_h
#define dgtkPovMeshes_h

#include "dgtkPovAppearance.h"

namespace dgtk
{

/// Collects shapes in file order; bare triangles between them are one mesh, in which equal vertices become one.
class PovShapeMaker
{
public:
  std::uint32_t vertex(const Eigen::Vector3d& position);
  std::int32_t normal(const Eigen::Vector3d& direction);
  std::int32_t uv(const Eigen::Vector2d& uv);
  std::int32_t texture(const PovTexturePointer& texture);
  void add(const PovMesh::Face& face) { this->Mesh->faces.push_back(face); }
  void add(const PovShape& shape);
  bool hasTriangles() const { return !this->Mesh->faces.empty(); }
  PovShape take();

private:
  std::shared_ptr<PovMesh> Mesh = std::make_shared<PovMesh>();
  std::map<std::array<double, 3>, std::uint32_t> Known;
  std::map<PovTexturePointer, std::int32_t> KnownTextures;
  PovShape Shape;
};

/// Reads triangles and meshes: what stands behind these words.
class PovMeshReader
{
public:
  PovMeshReader(PovSession& session, PovAppearance& appearance)
    : Session(session)
    , Stream(session.stream)
    , Appearance(appearance)
  {
  }
  void triangle(bool smooth, PovShapeMaker& to);
  PovShape mesh();
  PovShape mesh2();

private:
  using Triples = std::vector<std::array<std::uint32_t, 3>>;
  template <class Item>
  void list(const char* name, Item item);
  std::uint32_t index(double value, const PovPlace& place) const;
  std::uint32_t index();
  std::array<std::uint32_t, 3> indexTriple();
  void faces(PovMesh& mesh);
  void checkIndex(std::uint32_t index, std::size_t count, const char* what, const PovPlace& place) const;
  void checkFaces(const PovMesh& mesh, const PovPlace& place) const;
  void setCorners(PovMesh& mesh, std::array<std::int32_t, 3> PovMesh::Face::*to, const Triples& triples,
    std::size_t count, const std::string& what, const PovPlace& place) const;
  bool mesh2List(const PovToken& word, PovMesh& mesh, Triples& normals, Triples& uvs);

  PovSession& Session;
  PovStream& Stream;
  PovAppearance& Appearance;
};

} // namespace dgtk

#endif
