// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPointSpread_h
#define dgtkPointSpread_h

#include "dgtkRowWindow.h"
#include "dgtkSensorParameters.h"

namespace dgtk::sensor
{

/// Blurs rows of 3 channels; the image's edge is repeated outwards.
class PointSpread
{
public:
  explicit PointSpread(const PointSpreadParameters& parameters);
  int radius() const { return this->Radius; } ///< pixels
  /// The part that needs one row only.
  std::vector<float> prepare(std::vector<float> row) const;
  /// Row y of the blurred image, of prepared rows.
  std::vector<float> blur(const RowWindow<float>& rows, int y) const;

private:
  void addRow(const std::vector<float>& row, const double* weights, std::vector<double>& sum) const;
  int Radius = 0;
  bool Separable = true;
  std::vector<double> Weights; ///< (2 Radius + 1), or its square
};

} // namespace dgtk::sensor

#endif
