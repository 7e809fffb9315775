// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGlyphCopies.h"

#include "dgtkActorMaterial.h"
#include "dgtkError.h"
#include "dgtkSurfaceMaterial.h"

#include <Eigen/LU>
#include <vtkActor.h>
#include <vtkMapper.h>
#include <vtkPlaneCollection.h>
#include <vtkProperty.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace dgtk
{

namespace
{
constexpr double flattest = 1e-4; ///< smallest extent of a glyph, in its largest
constexpr double smallest = 1e-6; ///< largest extent of a glyph, in that of the largest one

using Tint = std::array<std::uint8_t, 4>;

Affine3 mirror()
{
  Affine3 made;
  made.linear(0, 0) = -1;
  return made;
}

/// A glyph's shape as a model, perhaps mirrored, so that what places it does not mirror; and its materials by tint.
class Shape
{
public:
  Shape(vtkActor& actor, SurfacePiece piece, bool mirrored, const ActorStyle& style)
    : Mirrored(mirrored)
  {
    GlyphPlace one = piece.glyphs.front();
    one.mapper_from_glyph = mirrored ? mirror() : Affine3();
    piece.glyphs.assign(1, one);
    SurfaceModel surface = surfaceModel(actor, { piece }, { Affine3(), style.lit, style.mirrored });
    auto model = std::make_shared<Model>(*surface.model);
    model->colors.clear();
    this->left = surface.left;
    this->TheModel = model;
  }

  std::uint32_t triangles() const { return std::uint32_t(this->TheModel->triangles.size()); }

  ModelCopy copy(const Affine3& place, const std::optional<Tint>& tint)
  {
    ModelCopy made;
    made.model = this->TheModel;
    made.materials = tint ? this->tinted(*tint)
                          : std::shared_ptr<const std::vector<Material>>(this->TheModel, &this->TheModel->materials);
    made.object_from_model = this->Mirrored ? place * mirror() : place;
    return made;
  }

  Unsupported left;

private:
  std::shared_ptr<const std::vector<Material>> tinted(const Tint& tint)
  {
    std::shared_ptr<const std::vector<Material>>& known = this->Tinted[tint];
    if (!known)
    {
      const Eigen::Vector3d color = Eigen::Vector3d(tint[0], tint[1], tint[2]) / 255;
      auto made = std::make_shared<std::vector<Material>>(this->TheModel->materials);
      for (Material& material : *made)
      {
        material.ambient = material.ambient.cwiseProduct(color).eval();
        material.diffuse = material.diffuse.cwiseProduct(color).eval();
        material.opacity *= tint[3] / 255.0;
      }
      known = made;
    }
    return known;
  }

  bool Mirrored;
  std::shared_ptr<const Model> TheModel;
  std::map<Tint, std::shared_ptr<const std::vector<Material>>> Tinted;
};

/// The glyphs of one piece, which are one part of the object.
class PieceCopies
{
public:
  PieceCopies(vtkActor& actor, const SurfacePiece& piece, const ActorStyle& style)
    : Actor(actor)
    , Piece(piece)
    , Style(style)
  {
  }

  /// Appends them; false where the shape has no triangles.
  bool append(std::uint32_t part, SurfaceModel& to, std::vector<ModelCopy>& copies)
  {
    const std::uint64_t first = copies.empty() ? 0 : to.triangles(copies);
    std::uint64_t inPart = 0;
    for (GlyphPlace glyph : this->Piece.glyphs)
    {
      if (glyph.color && isPhysical(this->Actor, this->Style.lit))
      {
        toDisplay(*glyph.color);
      }
      const Affine3 place = this->Style.bake * glyph.mapper_from_glyph;
      Shape& shape = this->shape(place.linear.determinant() < 0, to.left);
      if (shape.triangles() == 0)
      {
        return false;
      }
      if (first + inPart + shape.triangles() > std::numeric_limits<std::uint32_t>::max())
      {
        throw InputError("VTK scene", "has a glyph mapper with more triangles than there are numbers for",
          "at most 4294967295", "more");
      }
      ModelCopy copy = shape.copy(place, glyph.color);
      copy.firstPart = part;
      copy.firstInPart = std::uint32_t(inPart);
      copy.firstTriangle = std::uint32_t(first + inPart);
      copies.push_back(std::move(copy));
      to.cells.push_back(glyph.point);
      if (glyph.color)
      {
        to.tints.push_back(*glyph.color);
      }
      inPart += shape.triangles();
    }
    return true;
  }

private:
  Shape& shape(bool mirrored, Unsupported& left)
  {
    std::unique_ptr<Shape>& known = this->Shapes[mirrored ? 1 : 0];
    if (!known)
    {
      known = std::make_unique<Shape>(this->Actor, this->Piece, mirrored, this->Style);
      left = known->left; // every shape has the same property
    }
    return *known;
  }

  vtkActor& Actor;
  const SurfacePiece& Piece;
  const ActorStyle& Style;
  std::unique_ptr<Shape> Shapes[2];
};

/// Appends a model's vertices and triangles at a place.
void append(const Model& from, const Affine3& place, Model& to, Geometry& geometry)
{
  const auto first = std::uint32_t(geometry.positions.size());
  const Eigen::Matrix3d turn = normalMatrix(place.linear);
  for (const Eigen::Vector3d& position : from.rest->positions)
  {
    geometry.positions.push_back(place * position);
    to.sourceVertex.push_back(std::uint32_t(to.sourceVertex.size()));
  }
  for (const Eigen::Vector3f& normal : from.rest->normals)
  {
    geometry.normals.emplace_back((turn * normal.cast<double>()).normalized().cast<float>());
  }
  to.uvs.insert(to.uvs.end(), from.uvs.begin(), from.uvs.end());
  for (const auto& corners : from.triangles)
  {
    to.triangles.push_back({ first + corners[0], first + corners[1], first + corners[2] });
  }
}

/// The material of another model for one whose textures come after those that are there.
Material moved(Material material, int textures)
{
  for (const auto texture : materialTextures)
  {
    material.*texture += material.*texture >= 0 ? textures : 0;
  }
  return material;
}
} // namespace

bool canBeCopies(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const Affine3& bake)
{
  vtkProperty& property = *actor.GetProperty();
  vtkPlaneCollection* const planes = actor.GetMapper()->GetClippingPlanes();
  if ((planes != nullptr && planes->GetNumberOfItems() > 0) || property.GetBackfaceCulling() != 0 ||
      property.GetFrontfaceCulling() != 0 || pieces.empty())
  {
    return false;
  }
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const SurfacePiece& piece : pieces)
  {
    for (const GlyphPlace& glyph : piece.glyphs)
    {
      const Eigen::Vector3d extent = (bake.linear * glyph.mapper_from_glyph.linear).colwise().norm();
      if (!(extent.minCoeff() > flattest * extent.maxCoeff()) || !glyph.mapper_from_glyph.translation.allFinite())
      {
        return false;
      }
      least = std::min(least, extent.maxCoeff());
      most = std::max(most, extent.maxCoeff());
    }
    if (!piece.isGlyph)
    {
      return false;
    }
  }
  return least > smallest * most;
}

SurfaceModel glyphCopies(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const ActorStyle& style)
{
  SurfaceModel made;
  auto copies = std::make_shared<std::vector<ModelCopy>>();
  std::uint32_t part = 0;
  for (const SurfacePiece& piece : pieces)
  {
    part += PieceCopies(actor, piece, style).append(part, made, *copies) ? 1 : 0;
  }
  made.model = copies->empty() ? std::make_shared<const Model>() : copies->front().model;
  made.copies = copies;
  return made;
}

std::shared_ptr<const Model> writtenOut(const SurfaceModel& surface)
{
  auto model = std::make_shared<Model>();
  auto geometry = std::make_shared<Geometry>();
  model->format = surface.model->format;
  for (std::size_t i = 0; i < surface.copies->size(); ++i)
  {
    const ModelCopy& copy = (*surface.copies)[i];
    if (copy.firstPart == model->parts.size())
    {
      const std::string number = std::to_string(copy.firstPart + 1);
      model->parts.push_back({ "part-" + number, int(copy.firstPart), copy.firstTriangle, 0 });
      model->materials.push_back(moved(copy.model->materials.front(), int(model->textures.size())));
      model->materials.back().name = "material-" + number;
      model->textures.insert(model->textures.end(), copy.model->textures.begin(), copy.model->textures.end());
    }
    const std::size_t before = geometry->positions.size();
    model->uvs.resize(model->uvs.empty() && copy.model->uvs.empty() ? 0 : before, Eigen::Vector2d(0, 0));
    append(*copy.model, copy.object_from_model, *model, *geometry);
    model->unplaced.resize(model->triangles.size(), copy.model->hasUvs(0) ? 0 : 1); // a shape has one piece
    model->parts.back().triangles += std::uint32_t(copy.model->triangles.size());
    if (!surface.tints.empty())
    {
      model->colors.resize(geometry->positions.size(), surface.tints[i]);
    }
  }
  if (!model->uvs.empty())
  {
    model->uvs.resize(geometry->positions.size(), Eigen::Vector2d(0, 0));
  }
  else
  {
    model->unplaced.clear();
  }
  model->sourceVertices = geometry->positions.size();
  model->rest = geometry;
  return model;
}

} // namespace dgtk
