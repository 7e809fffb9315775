// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureCurve.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkRequestOptions.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double mostStops = 32;

/// A filmic curve: toe, nearly straight middle, shoulder (the fit of Narkowicz 2015 to the ACES reference curve).
float filmic(float x) { return std::min(1.0F, x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F)); }
} // namespace

PictureCurve::PictureCurve(const LayerRequest& request)
  : Filmic(option::tone().of(request.options) == "filmic")
{
  const std::vector<double> stops = option::exposure().of(request.options);
  if (!stops.empty())
  {
    if (std::abs(stops[0]) > mostStops)
    {
      throw UsageError("exposure: expected -32 to 32 stops, found " + shortest(stops[0]));
    }
    this->Factor = float(portable::pow(2, stops[0]));
  }
}

float PictureCurve::operator()(float encoded) const
{
  const float light = this->Factor * portable::linearFromEncoded(std::max(encoded, 0.0F));
  return portable::encodedFromLinear(this->Filmic ? filmic(light) : light);
}

} // namespace dgtk
