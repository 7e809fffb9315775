// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExposures.h"

#include "dgtkPortableMath.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <cmath>
#include <future>

namespace dgtk
{

void ExposedColor::set(std::vector<Exposure> exposures, StateAt stateAt)
{
  this->Exposures = std::move(exposures);
  this->At = std::move(stateAt);
}

void ExposedColor::draw(const PixelRect& rect, int samples, ColorBuffer& colors)
{
  std::vector<double> sums(std::size_t(rect.width) * rect.height * 3, 0.0);
  std::future<void> adding; // of the exposure before; one at a time, so that the order of the sum is fixed
  const auto settle = [&]
  {
    if (adding.valid())
    {
      this->Pool.wait(adding);
    }
  };
  try
  {
    for (const Exposure& exposure : this->Exposures)
    {
      auto drawn = std::make_shared<ColorBuffer>();
      this->Source.setScene(this->At(exposure.frame), exposure.view);
      std::function<void()> rest = this->Source.drawColor(rect, samples, *drawn, nullptr);
      settle();
      adding = this->Pool.submit(
        [&sums, drawn, rest = std::move(rest)]
        {
          rest();
          std::transform(sums.begin(), sums.end(), drawn->rgb.begin(), sums.begin(),
            [](double sum, float value) { return sum + double(portable::linearFromEncoded(value)); });
        });
    }
    settle();
  }
  catch (...)
  {
    if (adding.valid())
    {
      adding.wait();
    }
    throw;
  }
  colors.resize(rect);
  const double count = double(this->Exposures.size());
  std::transform(sums.begin(), sums.end(), colors.rgb.begin(),
    [count](double sum) { return portable::encodedFromLinear(float(sum / count)); });
}

} // namespace dgtk
