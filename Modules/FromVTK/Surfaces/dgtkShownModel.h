// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShownModel_h
#define dgtkShownModel_h

#include "dgtkModel.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

class vtkActor;

namespace dgtk
{

/// What a camera is shown of a model.
struct ShownSurface
{
  std::vector<Eigen::Vector4d> planes; ///< in the axes of the model; what is on their positive side is there
  /// Whether a triangle (corners in the axes of the model) is left out for the side that is seen; empty: none.
  std::function<bool(const Eigen::Vector3d corners[3])> isCulled;

  bool isAll() const { return this->planes.empty() && !this->isCulled; }
};

/// A model that is a part of another one.
struct ShownModel
{
  std::shared_ptr<const Model> model;
  std::vector<std::uint32_t> parents; ///< triangles of the other one, ascending, one a triangle; empty: the same
};

/// The triangles that are shown, cut along the planes (Sutherland and Hodgman 1974) in double precision.
/// Normals at a cut are those between the corners, and so shorter than 1: within, they stay what they were.
ShownModel shownModel(const std::shared_ptr<const Model>& model, const ShownSurface& shown);

} // namespace dgtk

#endif
