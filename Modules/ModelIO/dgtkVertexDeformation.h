// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkVertexDeformation_h
#define dgtkVertexDeformation_h

#include "dgtkModel.h"

namespace dgtk
{

/// One whose vertices do not depend on one another: a few cost less than all.
class DGTKMODELIO_EXPORT VertexDeformation : public Deformation
{
public:
  /// What positionsAt() writes for one vertex of the file, to the bit.
  virtual Eigen::Vector3d positionAt(int animation, double frame, std::uint32_t sourceVertex) const = 0;
};

} // namespace dgtk

#endif
