// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLineActor_h
#define dgtkLineActor_h

#include "dgtkViewLines.h"
#include "dgtkViewsModule.h"

#include <vtkNew.h>

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace dgtk
{

/// Line segments of one colour in a view.
class DGTKVIEWS_EXPORT LineActor
{
public:
  /// `width`: pixels.
  LineActor(vtkRenderer* renderer, const Eigen::Vector3d& color, double width);
  ~LineActor();
  LineActor(const LineActor&) = delete;
  LineActor& operator=(const LineActor&) = delete;

  void set(const LineList& lines);
  void show(bool on);

private:
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkActor> Actor;
  bool Filled = false;
};

} // namespace dgtk

#endif
