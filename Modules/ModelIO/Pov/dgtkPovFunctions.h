// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovFunctions_h
#define dgtkPovFunctions_h

#include "dgtkPovSymbols.h"

#include <string>
#include <vector>

namespace dgtk
{

/// A function of POV-Ray's own, of floats and vectors, as version 3.7 computes it.
struct PovFunction
{
  std::size_t fewest; ///< arguments
  std::size_t most;
  PovNumber (*value)(const std::vector<PovNumber>& arguments); ///< not finite where there is none
};
/// Null for other names.
const PovFunction* povFunction(const std::string& name);

/// A float used as a vector has it in all components.
std::array<double, 5> promoted(const PovNumber& number, int to);
/// Rotation by degrees about the x axis, then the y axis, then the z axis; exact for quarter turns.
Eigen::Matrix3d povRotation(const Eigen::Vector3d& degrees);

} // namespace dgtk

#endif
