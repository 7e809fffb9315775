// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewOutputs_h
#define dgtkViewOutputs_h

#include "dgtkRenderer.h"
#include "dgtkScene.h"
#include "dgtkSnapshot.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// Whose picture a source gives, and how: a renderer or a scene.
struct ViewRequest
{
  vtkSmartPointer<vtkRenderer> renderer;
  vtkSmartPointer<dgtkScene> scene;
  std::string camera;
  int frame = 0;
  bool frameSet = false;
  std::string layers = "depth";
  int width = 0;
  int height = 0;
  bool skip = false;
  std::map<std::string, std::string> options;
};

/// Pictures of a request, rows from top to bottom.
struct ViewOutputs
{
  int width = 0;
  int height = 0;
  std::vector<vtkSmartPointer<vtkDataArray>> arrays; ///< those of the first layer that was asked for first
  vtkSmartPointer<dgtkSnapshot> shot;                ///< of a renderer

  vtkDataArray* find(const char* name) const;
};

/// Throws Error with one line.
ViewOutputs outputsOf(const ViewRequest& request);

/// When a renderer, or something that it shows, was last modified.
vtkMTimeType modifiedTime(vtkRenderer& renderer);

} // namespace dgtk

#endif
