// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkVectorRows_h
#define dgtkVectorRows_h

// Private to Panels: vectors in rows of three numbers.

#include "dgtkNumberRow.h"

#include <Eigen/Core>
#include <QFormLayout>

#include <vector>

namespace dgtk
{

inline std::vector<double> listOf(const Eigen::Vector3d& v) { return { v.x(), v.y(), v.z() }; }
inline Eigen::Vector3d vectorOf(const std::vector<double>& v) { return { v[0], v[1], v[2] }; }
inline Eigen::Vector3d vectorOf(const NumberRow* row) { return vectorOf(row->values()); }

/// A row of a form with as many fields as values.
inline NumberRow* addVectorRow(
  QFormLayout* form, const QString& label, const QString& name, const std::vector<double>& values)
{
  auto* row = new NumberRow(name, static_cast<int>(values.size()), nullptr);
  row->setValues(values);
  form->addRow(label, row);
  return row;
}

} // namespace dgtk

#endif
