// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkDepthFromZBuffer
 * @brief What a z-buffer means in scene units, and how sure that is.
 *
 * The input is what vtkWindowToImageFilter gives of a z-buffer (values from 0, near, to 1, far or nothing), drawn with
 * the camera; the output has two arrays of points in its place, double precision: "depth", z in the camera frame, +inf
 * where the buffer is 1, and "half_width": the depth of the surface's point at the pixel's centre lies within it. It is
 * the sum of
 *
 * - the buffer's quantisation: half a step of 2^-DepthBits, and the rounding of OpenGL's single precision,
 * RoundingSteps steps of 2^-24, each times the change of depth with the buffer's value;
 * - the place at which the buffer was sampled: vertices are drawn at multiples of 2^-SubpixelBits pixels, so the sample
 *   is half of that beside the centre in each direction, times the change of depth to the nearer of both neighbours.
 *
 * Pixels whose centre is nearer than that to a surface's edge may show what is beside it; nothing in a z-buffer tells.
 * dgtkGroundTruthSource has the depth itself.
 */
#ifndef dgtkDepthFromZBuffer_h
#define dgtkDepthFromZBuffer_h

#include "dgtkFromVTKModule.h"
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // the camera

class vtkCamera;

class DGTKFROMVTK_EXPORT dgtkDepthFromZBuffer : public vtkImageAlgorithm
{
public:
  static dgtkDepthFromZBuffer* New();
  vtkTypeMacro(dgtkDepthFromZBuffer, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The camera that the z-buffer was drawn with, with its clipping range of then.
   */
  void SetCamera(vtkCamera* camera);

  ///@{
  /**
   * Bits of the buffer's values (1 to 32, default 24), and of the places of vertices within a pixel (0 to 16, default
   * 8, which is Mesa's and most hardware's).
   */
  vtkSetClampMacro(DepthBits, int, 1, 32);
  vtkGetMacro(DepthBits, int);
  vtkSetClampMacro(SubpixelBits, int, 0, 16);
  vtkGetMacro(SubpixelBits, int);
  ///@}
  ///@{
  /**
   * Roundings to single precision on the way of a vertex into the buffer; default 4.
   */
  vtkSetClampMacro(RoundingSteps, double, 0, 1000);
  vtkGetMacro(RoundingSteps, double);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  dgtkDepthFromZBuffer();
  ~dgtkDepthFromZBuffer() override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  dgtkDepthFromZBuffer(const dgtkDepthFromZBuffer&) = delete;
  void operator=(const dgtkDepthFromZBuffer&) = delete;

  vtkSmartPointer<vtkCamera> Camera;
  int DepthBits = 24;
  int SubpixelBits = 8;
  double RoundingSteps = 4;
};

#endif
