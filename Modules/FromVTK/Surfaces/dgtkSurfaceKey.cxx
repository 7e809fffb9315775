// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceKey.h"

#include "dgtkActorMaterial.h"
#include "dgtkSurfaceModel.h"
#include "dgtkSurfacePieces.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkScalarsToColors.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>
#include <vtkTransform.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstddef>
#include <string>
#include <type_traits>

namespace dgtk
{

namespace
{
class KeyMaker
{
public:
  KeyMaker() { XXH3_128bits_reset(&this->State); }

  SurfaceKey key() const
  {
    const XXH128_hash_t hash = XXH3_128bits_digest(&this->State);
    return { hash.high64, hash.low64 };
  }

  template <class Number>
  void add(const Number* numbers, std::size_t count)
  {
    static_assert(std::is_arithmetic<Number>::value, "structures may have bytes without meaning");
    XXH3_128bits_update(&this->State, numbers, count * sizeof(Number));
  }

  template <class Number>
  void add(Number number)
  {
    this->add(&number, 1);
  }

  void add(const Affine3& affine)
  {
    this->add(affine.linear.data(), 9);
    this->add(affine.translation.data(), 3);
  }

  void add(vtkDataArray* array)
  {
    this->add(array != nullptr);
    if (array == nullptr)
    {
      return;
    }
    this->add(array->GetDataType());
    this->add(array->GetNumberOfComponents());
    this->add(array->GetNumberOfTuples());
    if (array->HasStandardMemoryLayout())
    {
      this->add(static_cast<const unsigned char*>(array->GetVoidPointer(0)),
        std::size_t(array->GetNumberOfValues()) * std::size_t(array->GetDataTypeSize()));
      return;
    }
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      this->add(array->GetTuple(i), std::size_t(array->GetNumberOfComponents()));
    }
  }

  void add(vtkCellArray* cells)
  {
    this->add(cells != nullptr);
    if (cells != nullptr)
    {
      this->add(static_cast<vtkDataArray*>(cells->GetOffsetsArray()));
      this->add(static_cast<vtkDataArray*>(cells->GetConnectivityArray()));
    }
  }

  void add(vtkImageData* picture)
  {
    this->add(picture != nullptr);
    if (picture != nullptr)
    {
      this->add(picture->GetDimensions(), 3);
      this->add(picture->GetPointData()->GetScalars());
    }
  }

  void add(vtkTexture* texture)
  {
    this->add(texture != nullptr);
    if (texture == nullptr)
    {
      return;
    }
    texture->Update();
    this->add(texture->GetMTime());
    this->add(texture->GetLookupTable() != nullptr ? texture->GetLookupTable()->GetMTime() : 0);
    this->add(texture->GetInput());
    if (texture->GetTransform() != nullptr)
    {
      this->add(&texture->GetTransform()->GetMatrix()->Element[0][0], 16);
    }
  }

  void add(const SurfacePiece& piece)
  {
    vtkPolyData& data = *piece.data;
    this->add(data.GetPoints() != nullptr ? data.GetPoints()->GetData() : nullptr);
    this->add(data.GetNumberOfVerts() + data.GetNumberOfLines());
    this->add(data.GetPolys());
    this->add(data.GetStrips());
    this->add(data.GetPointData()->GetNormals());
    this->add(data.GetCellData()->GetNormals());
    this->add(data.GetPointData()->GetTCoords());
    this->add(data.GetPointData()->GetTangents());
    this->add(piece.cells.Get());
    this->add(piece.firstCell);
    this->add(static_cast<vtkDataArray*>(piece.colors.Get()));
    this->add(piece.colorsOfCells);
    this->add(static_cast<vtkDataArray*>(piece.colorMapAt.Get()));
    this->add(piece.colorMap.Get());
    this->add(piece.blockColor ? piece.blockColor->data() : nullptr, piece.blockColor ? 3 : 0);
    this->add(piece.blockColor.has_value());
    this->add(piece.blockOpacity.value_or(-1.0));
    this->add(piece.isGlyph);
    this->add(piece.glyphs.size());
    for (const GlyphPlace& glyph : piece.glyphs)
    {
      this->add(glyph.mapper_from_glyph);
      this->add(glyph.point);
      this->add(glyph.color.has_value());
      this->add(glyph.color.value_or(std::array<std::uint8_t, 4>{}).data(), 4);
    }
  }

private:
  XXH3_state_t State;
};
} // namespace

SurfaceKey surfaceKey(vtkActor& actor, const std::vector<SurfacePiece>& pieces, const ActorStyle& style, bool copies)
{
  KeyMaker maker;
  maker.add(style.bake);
  maker.add(style.lit);
  maker.add(style.mirrored);
  maker.add(copies);
  vtkProperty& property = *actor.GetProperty();
  maker.add(property.GetMTime());
  maker.add(actor.GetBackfaceProperty() != nullptr);
  maker.add(actor.GetForceOpaque());
  maker.add(actor.GetShaderProperty()->GetNumberOfShaderReplacements());
  maker.add(actor.GetTexture());
  const std::string change = changeOfCoordinates(actor);
  maker.add(change.data(), change.size());
  for (const auto& [name, texture] : property.GetAllTextures())
  {
    maker.add(texture);
  }
  for (const SurfacePiece& piece : pieces)
  {
    maker.add(piece);
  }
  return maker.key();
}

} // namespace dgtk
