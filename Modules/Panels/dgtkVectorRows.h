// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkVectorRows_h
#define dgtkVectorRows_h

// Private to Panels: vectors in rows of three numbers.

#include "dgtkNumberRow.h"

#include <Eigen/Core>

#include <vector>

namespace dgtk
{

inline std::vector<double> listOf(const Eigen::Vector3d& v) { return { v.x(), v.y(), v.z() }; }
inline Eigen::Vector3d vectorOf(const std::vector<double>& v) { return { v[0], v[1], v[2] }; }
inline Eigen::Vector3d vectorOf(const NumberRow* row) { return vectorOf(row->values()); }

} // namespace dgtk

#endif
