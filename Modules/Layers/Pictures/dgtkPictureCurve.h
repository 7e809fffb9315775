// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureCurve_h
#define dgtkPictureCurve_h

// Private to Layers.

#include "dgtkLayerRequest.h"

#include <vector>

namespace dgtk
{

/// What is done to the light of pictures before their file's format cuts it: first the exposure, then the tone curve.
class PictureCurve
{
public:
  /// Changes nothing.
  PictureCurve() = default;
  /// Throws UsageError for an exposure out of range.
  explicit PictureCurve(const LayerRequest& request);

  bool changes() const { return this->Factor != 1 || this->Filmic; }
  /// Of a display-referred value, which may be above 1.
  float operator()(float encoded) const;

private:
  float Factor = 1;
  bool Filmic = false;
};

} // namespace dgtk

#endif
