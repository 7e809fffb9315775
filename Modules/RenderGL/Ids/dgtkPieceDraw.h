// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPieceDraw_h
#define dgtkPieceDraw_h

#include "dgtkPieces.h"
#include "dgtkRasterModels.h"

class vtkOpenGLShaderProperty;

namespace dgtk
{

/// The triangles of a chunk, whose positions are relative to the origin of its geometry.
PieceRange pieceRange(const RasterModel& model, const RasterChunk& chunk, const Eigen::Matrix4d& view_from_local);

/// What draws the cut triangles of a chunk. The context must be current.
class PieceDraw
{
public:
  PieceDraw(vtkOpenGLRenderWindow* window, RasterFrame& frame, vtkOpenGLShaderProperty* shaders,
    const RasterModel& model, const RasterChunk& chunk);
  ~PieceDraw();
  PieceDraw(const PieceDraw&) = delete;
  PieceDraw& operator=(const PieceDraw&) = delete;

  /// Takes pieces in the place of `whole`, the actor of all triangles, which is left the others.
  void fill(const Pieces& pieces, const RasterCamera& camera, PartActor& whole);
  PartMapper& mapper() const { return *this->Mapper; }
  PartActor& actor() const { return *this->Actor; }

private:
  vtkOpenGLRenderWindow* Window;
  vtkSmartPointer<vtkPolyData> Data;
  vtkSmartPointer<PartMapper> Mapper;
  vtkSmartPointer<PartActor> Actor;
};

} // namespace dgtk

#endif
