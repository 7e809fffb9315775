// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxGeometry.h"

#include <algorithm>
#include <cmath>

namespace dgtk::import
{

namespace
{
enum class By
{
  Corner,
  ControlPoint,
  Polygon,
  All,
  Unknown
};

By mappingOf(const FbxElement& layer)
{
  const FbxElement* mapping = layer.find("MappingInformationType");
  const std::string& said = mapping != nullptr ? mapping->text(0) : std::string();
  return said == "ByPolygonVertex"                             ? By::Corner
         : said == "ByVertice" || said == "ByVertex"           ? By::ControlPoint
         : said == "ByPolygon"                                 ? By::Polygon
         : said == "AllSame" || said == "NoMappingInformation" ? By::All
                                                               : By::Unknown;
}

/// A layer element: `width` numbers for each corner, control point or polygon, directly or by an index.
class LayerValues
{
public:
  LayerValues(const FbxElement& layer, const char* values, const char* indices, std::size_t width)
    : Mapping(mappingOf(layer))
    , Width(width)
  {
    this->Values = layer.numbers(values);
    const FbxElement* reference = layer.find("ReferenceInformationType");
    if (layer.find(indices) != nullptr && (reference == nullptr || reference->text(0) != "Direct"))
    {
      this->Indices = layer.integers(indices);
      this->IsIndexed = true;
    }
  }

  bool isKnown() const { return this->Mapping != By::Unknown && !this->Values.empty(); }

  /// The values of a vertex, or null.
  const double* of(const FbxPart& part, std::size_t vertex) const
  {
    std::size_t at = this->Mapping == By::Corner         ? part.corners[vertex]
                     : this->Mapping == By::ControlPoint ? part.controlPoints[vertex]
                     : this->Mapping == By::Polygon      ? part.polygons[vertex]
                                                         : 0;
    if (this->IsIndexed)
    {
      if (at >= this->Indices.size() || this->Indices[at] < 0)
      {
        return nullptr;
      }
      at = static_cast<std::size_t>(this->Indices[at]);
    }
    return at < this->Values.size() / this->Width ? &this->Values[at * this->Width] : nullptr;
  }

private:
  By Mapping;
  std::size_t Width;
  std::vector<double> Values;
  std::vector<std::int64_t> Indices;
  bool IsIndexed = false;
};

} // namespace

FbxGeometry::FbxGeometry(const FbxElement& element)
  : Element(element)
{
  this->Positions = element.numbers("Vertices");
  if (const FbxElement* layer = element.find("LayerElementMaterial"))
  {
    const By mapping = mappingOf(*layer);
    if (mapping == By::Polygon || mapping == By::All)
    {
      this->Slots = layer->integers("Materials");
      this->Slots.resize(mapping == By::All ? std::min<std::size_t>(this->Slots.size(), 1) : this->Slots.size());
    }
  }
  const std::vector<std::int64_t> indices = element.integers("PolygonVertexIndex");
  std::size_t begin = 0;
  std::size_t polygon = 0;
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    if (indices[i] < 0 || i + 1 == indices.size())
    {
      this->addPolygon(indices, begin, i + 1, polygon);
      begin = i + 1;
      ++polygon;
    }
  }
  this->addNormals();
}

void FbxGeometry::addPolygon(
  const std::vector<std::int64_t>& indices, std::size_t begin, std::size_t end, std::size_t polygon)
{
  const auto pointOf = [&indices](std::size_t i) { return indices[i] < 0 ? ~indices[i] : indices[i]; };
  for (std::size_t i = begin; i < end; ++i)
  {
    if (pointOf(i) >= static_cast<std::int64_t>(this->controlPoints()))
    {
      ++this->BadPolygons;
      return;
    }
  }
  const std::int64_t said = this->Slots.empty()            ? 0
                            : this->Slots.size() == 1      ? this->Slots[0]
                            : polygon < this->Slots.size() ? this->Slots[polygon]
                                                           : 0;
  const auto [known, isNew] =
    this->PartOfSlot.try_emplace(std::size_t(std::max<std::int64_t>(said, 0)), this->Parts.size());
  if (isNew)
  {
    this->Parts.emplace_back().slot = known->first;
  }
  FbxPart& part = this->Parts[known->second];
  part.mesh.faceSizes.push_back(static_cast<std::uint32_t>(end - begin));
  for (std::size_t i = begin; i < end; ++i)
  {
    const auto point = static_cast<std::size_t>(pointOf(i));
    part.mesh.faceVertices.push_back(static_cast<std::uint32_t>(part.controlPoints.size()));
    part.controlPoints.push_back(static_cast<std::uint32_t>(point));
    part.corners.push_back(i);
    part.polygons.push_back(polygon);
    const double* p = &this->Positions[3 * point];
    part.mesh.positions.push_back({ float(p[0]), float(p[1]), float(p[2]) });
  }
}

void FbxGeometry::addNormals()
{
  const FbxElement* layer = this->Element.find("LayerElementNormal");
  if (layer == nullptr)
  {
    return;
  }
  const LayerValues values(*layer, "Normals", "NormalsIndex", 3);
  for (FbxPart& part : this->Parts)
  {
    for (std::size_t i = 0; values.isKnown() && i < part.mesh.positions.size(); ++i)
    {
      const double* n = values.of(part, i);
      part.mesh.normals.push_back(n != nullptr ? Float3{ float(n[0]), float(n[1]), float(n[2]) } : Float3{ 0, 0, 0 });
    }
  }
}

std::vector<std::array<float, 2>> FbxGeometry::uvs(const FbxPart& part, const std::string& set) const
{
  const FbxElement* layer = nullptr;
  for (const FbxElement& child : this->Element.children)
  {
    const FbxElement* name = child.name == "LayerElementUV" ? child.find("Name") : nullptr;
    if (child.name == "LayerElementUV" && (layer == nullptr || (name != nullptr && name->text(0) == set)))
    {
      layer = &child;
    }
  }
  std::vector<std::array<float, 2>> all;
  if (layer != nullptr)
  {
    const LayerValues values(*layer, "UV", "UVIndex", 2);
    for (std::size_t i = 0; values.isKnown() && i < part.mesh.positions.size(); ++i)
    {
      const double* uv = values.of(part, i);
      all.push_back(
        uv != nullptr ? std::array<float, 2>{ float(uv[0]), float(uv[1]) } : std::array<float, 2>{ NAN, NAN });
    }
  }
  return all;
}

} // namespace dgtk::import
