// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxGeometry_h
#define dgtkFbxGeometry_h

#include "dgtkAssimpStream.h"
#include "dgtkFbxScene.h"

#include <map>

namespace dgtk::import
{

/// The part of a geometry that has one material.
struct FbxPart
{
  std::size_t slot = 0;                     ///< among the materials of the model
  Mesh mesh;                                ///< a vertex for each corner; without texture coordinates and bones
  std::vector<std::uint32_t> controlPoints; ///< of each vertex
  std::vector<std::size_t> corners;         ///< of each vertex: where the file has it, for layers by corner
  std::vector<std::size_t> polygons;        ///< of each vertex
};

/// A "Mesh" geometry: polygons, normals, texture coordinates.
class FbxGeometry
{
public:
  explicit FbxGeometry(const FbxElement& element);

  /// By material, in the order in which polygons use them.
  const std::vector<FbxPart>& parts() const { return this->Parts; }
  /// Texture coordinates of a part's vertices: of the set of that name, or the first one. Empty when there are none.
  std::vector<std::array<float, 2>> uvs(const FbxPart& part, const std::string& set) const;
  std::size_t controlPoints() const { return this->Positions.size() / 3; }
  std::size_t badPolygons() const { return this->BadPolygons; }
  bool hasColors() const { return this->Element.find("LayerElementColor") != nullptr; }

private:
  void addPolygon(const std::vector<std::int64_t>& indices, std::size_t begin, std::size_t end, std::size_t polygon);
  void addNormals();

  const FbxElement& Element;
  std::vector<double> Positions;
  std::vector<std::int64_t> Slots; ///< of each polygon, one for all, or none
  std::vector<FbxPart> Parts;
  std::map<std::size_t, std::size_t> PartOfSlot;
  std::size_t BadPolygons = 0;
};

} // namespace dgtk::import

#endif
