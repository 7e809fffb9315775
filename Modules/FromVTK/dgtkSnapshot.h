// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkSnapshot
 * @brief What a VTK renderer shows, frozen: a scene of one camera, one frame and an object for each visible actor.
 *
 * It takes surfaces: actors, also in assemblies, that draw vtkPolyData, composite data, the surface of other data sets
 * or glyphs. Objects have the ids 1, 2, ... in the order in which the renderer has its props, those without triangles
 * left out. Nothing is drawn: the renderer needs no window and no display. What changes afterwards does not change the
 * snapshot.
 *
 * Pixels: rows from top to bottom, the centre of the first one is (0.5, 0.5). Methods that can fail return false, or
 * null, and leave a line in GetErrorMessage().
 */
#ifndef dgtkSnapshot_h
#define dgtkSnapshot_h

#include "dgtkFromVTKModule.h"
#include "dgtkScene.h"

#include <memory> // private state
#include <string> // names

class vtkDataArray;
class vtkProp;
class vtkRenderer;

class DGTKFROMVTK_EXPORT dgtkSnapshot : public dgtkScene
{
public:
  static dgtkSnapshot* New();
  vtkTypeMacro(dgtkSnapshot, dgtkScene);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What is no surface (lines, points, volumes, two-dimensional props), or cannot be honoured, is refused by name
   * (default), or left out and told by GetLeftOut(), one a line.
   */
  vtkSetMacro(SkipUnsupported, bool);
  vtkGetMacro(SkipUnsupported, bool);
  std::string GetLeftOut() const;
  ///@}

  /**
   * Takes the view of a renderer in an image of width x height pixels; 0, 0: the renderer's own size.
   */
  bool Take(vtkRenderer* renderer, int width = 0, int height = 0);

  ///@{
  /**
   * The prop of the object with id index + 1; parts of assemblies are props of their own.
   */
  int GetNumberOfProps() const;
  vtkProp* GetProp(int index) const;
  ///@}
  /**
   * Number of cells that the input of a prop's mapper had, or of points that glyphs stand at.
   */
  vtkIdType GetNumberOfCells(int index) const;

  ///@{
  /**
   * Size of the image in pixels, and the camera: matrix K (3 x 3, by rows), rotation R and translation t of
   * x_camera = R x_world + t; camera axes x right, y down, z forward. Of a parallel projection K holds pixels a scene
   * unit.
   */
  int GetWidth() const;
  int GetHeight() const;
  void GetK(double K[9]) const;
  void GetR(double R[9]) const;
  void GetT(double t[3]) const;
  ///@}

  /**
   * The cell that each pixel sees, of the input of its prop's mapper: height x width numbers of 64 bits, -1 nothing.
   * Cells of composite data are counted through its blocks; those of glyphs are the points that they stand at.
   */
  vtkDataArray* TraceCells();
  ///@{
  /**
   * For the prop with id index + 1 the number of pixels that see each of its cells, after CountCells().
   */
  bool CountCells();
  vtkDataArray* CountPixels(int index);
  ///@}

  ///@{
  /**
   * Where what each pixel of this snapshot sees is in another one of the same actors: height x width x 2 pixels, not a
   * number where it is nowhere, and its class (0 no surface, 1 visible, 2 hidden by another object, 3 by its own, 4
   * outside the image, 5 behind the camera). Camera, actors and points may have moved; the cells must be the same.
   */
  bool Correspond(dgtkSnapshot* other);
  vtkDataArray* GetPositions() const;
  vtkDataArray* GetClasses() const;
  ///@}

  ///@{
  /**
   * Writes the snapshot as a scene (.json) with its models in a folder `models` beside it and its textures there. What
   * these files have otherwise is told by GetChanges(), one a line.
   */
  bool Save(const std::string& path);
  std::string GetChanges() const;
  ///@}

protected:
  dgtkSnapshot();
  ~dgtkSnapshot() override;

  bool SkipUnsupported = false;

private:
  dgtkSnapshot(const dgtkSnapshot&) = delete;
  void operator=(const dgtkSnapshot&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
