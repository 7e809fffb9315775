// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkPointCloudSource
 * @brief What a VTK renderer shows as points: one for each pixel that sees a surface.
 *
 * The output is a vtkPolyData of vertices, world coordinates in double precision, in the order of the pixels (rows from
 * the top), with arrays of points: "Normals" (unit normals of the triangles, world, on the side of the camera),
 * "objects" (ids of dgtkSnapshot), "cells" (of the inputs of the mappers), "Colors" (R, G, B as shown, its scalars) and
 * "pixels" (column and row of the pixel's centre, x + 0.5, y + 0.5).
 */
#ifndef dgtkPointCloudSource_h
#define dgtkPointCloudSource_h

#include "dgtkFromVTKModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory> // private state

class vtkRenderer;

class DGTKFROMVTK_EXPORT dgtkPointCloudSource : public vtkPolyDataAlgorithm
{
public:
  static dgtkPointCloudSource* New();
  vtkTypeMacro(dgtkPointCloudSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void SetRenderer(vtkRenderer* renderer);
  /**
   * Size of the picture in pixels; 0, 0 (default): the renderer's.
   */
  void SetSize(int width, int height);
  /**
   * What is no surface is left out, instead of being an error.
   */
  void SetSkipUnsupported(bool skip);

  vtkMTimeType GetMTime() override;

protected:
  dgtkPointCloudSource();
  ~dgtkPointCloudSource() override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  dgtkPointCloudSource(const dgtkPointCloudSource&) = delete;
  void operator=(const dgtkPointCloudSource&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
