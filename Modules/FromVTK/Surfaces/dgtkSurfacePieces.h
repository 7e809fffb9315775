// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfacePieces_h
#define dgtkSurfacePieces_h

#include "dgtkRendererProps.h"
#include "dgtkUnsupported.h"

#include <Eigen/Core>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <optional>
#include <vector>

class vtkMapper;

namespace dgtk
{

/// A glyph: where it is in its mapper's frame, and the point that it stands at.
struct GlyphPlace
{
  Affine3 mapper_from_glyph;
  vtkIdType point = 0;
  std::optional<std::array<std::uint8_t, 4>> color; ///< R, G, B, A
};

/// Polygons and strips of what a mapper draws, in the frame of its actor.
struct SurfacePiece
{
  vtkSmartPointer<vtkPolyData> data;
  vtkSmartPointer<vtkDataArray> cells; ///< of the mapper's input, by cell of `data`; null: the same from `firstCell` on
  vtkIdType firstCell = 0;
  std::vector<GlyphPlace> glyphs; ///< `data` is drawn at each of them; their points are the cells
  bool isGlyph = false;

  vtkSmartPointer<vtkUnsignedCharArray> colors; ///< R, G, B, A of points or, `colorsOfCells`, cells of `data`; or null
  bool colorsOfCells = false;
  vtkSmartPointer<vtkFloatArray> colorMapAt; ///< instead of colours: places of the points in `colorMap`
  vtkSmartPointer<vtkImageData> colorMap;
  std::optional<Eigen::Vector3d> blockColor; ///< instead of the property's ambient and diffuse colour
  std::optional<double> blockOpacity;        ///< instead of the property's
};

/// What a mapper draws.
struct DrawnSurface
{
  std::vector<SurfacePiece> pieces;
  vtkIdType cells = 0; ///< of the mapper's input, also those that are no surface
};

/// What the actor's mapper draws: its pipeline is brought up to date. Cells are numbered as the input of the mapper has
/// them: of composite data through all leaves, one after the other; of glyphs by the point of the input.
DrawnSurface surfacePieces(const ViewActor& actor, Unsupported& unsupported);

/// The glyphs of a vtkGlyph3DMapper.
DrawnSurface glyphPieces(const ViewActor& actor, vtkMapper& mapper, Unsupported& unsupported);

/// The colours that a mapper gives to a data set, which need not be its input, with an opacity in their alpha.
void mapColors(vtkMapper& mapper, vtkDataSet& data, SurfacePiece& piece, double opacity = 1);

} // namespace dgtk

#endif
