// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewMeshes_h
#define dgtkViewMeshes_h

#include "dgtkSceneState.h"

#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>
#include <memory>
#include <utility>

class vtkImageData;
class vtkPolyData;
class vtkTexture;

namespace dgtk
{

/// Geometry and pictures of models as VTK's data, each once for all views and all copies.
class ViewMeshes
{
public:
  ViewMeshes();
  ~ViewMeshes();
  ViewMeshes(const ViewMeshes&) = delete;
  ViewMeshes& operator=(const ViewMeshes&) = delete;

  /// The triangles of one part. The points are shared by the parts. `level`, below levels: the higher, the fewer
  /// triangles, for a model of at most pixels(level) from corner to corner; those of a lower level where fewer would
  /// not look the same.
  vtkPolyData* part(const Geometry& geometry, const Model& model, std::size_t part, int level);
  static constexpr int levels = 3;
  static double pixels(int level);
  vtkPolyData* part(const Instance& instance, std::size_t part);
  /// RGBA for cut-outs, RGB for others; null without a picture.
  vtkImageData* picture(const std::shared_ptr<const Image>& image, bool cutOut);
  /// It for one view, with mip-maps that are made once for all; null without a picture.
  vtkSmartPointer<vtkTexture> texture(const std::shared_ptr<const Image>& image, bool cutOut);
  /// Forgets poses that nobody shows, and all of models and pictures that nobody else holds.
  void forgetUnused();

private:
  struct Mesh;
  struct Picture;
  std::map<const Geometry*, std::unique_ptr<Mesh>> Meshes;
  std::map<std::pair<const Image*, bool>, std::unique_ptr<Picture>> Pictures;
};

} // namespace dgtk

#endif
