// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRandomCameras_h
#define dgtkRandomCameras_h

#include "dgtkCameraEntry.h"
#include "dgtkError.h"

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace dgtk::test
{

/// Cameras of the models of the registry, their parameters drawn within what the rows say.
class RandomCameras
{
public:
  explicit RandomCameras(unsigned seed)
    : Random(seed)
  {
  }
  double between(double least, double most)
  {
    return std::uniform_real_distribution<double>(least, most)(this->Random);
  }

  /// Null for parameters that the model refuses together. `numbers` is how many a list has; 0: any that it may have.
  std::shared_ptr<const CameraModel> make(const CameraRow& row, std::size_t numbers = 0)
  {
    CameraParameters of{ int(this->between(20, 900)), int(this->between(20, 700)), std::nullopt };
    for (const CameraParameter& parameter : row.entry->parameters)
    {
      if (parameter.kind == CameraParameter::Kind::Matrix && this->between(0, 1) < 0.75)
      {
        of.K = this->matrix(of.width, of.height);
      }
    }
    for (const CameraParameter& parameter : row.entry->parameters)
    {
      if (parameter.kind == CameraParameter::Kind::Numbers && !(of.K && parameter.saidByK))
      {
        of.numbers[parameter.name] = this->draw(parameter, numbers);
      }
    }
    try
    {
      return makeCamera(row.model, of);
    }
    catch (const UsageError&)
    {
      return nullptr;
    }
  }

private:
  Eigen::Matrix3d matrix(int width, int height)
  {
    Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
    K(0, 0) = this->between(0.2, 2) * height;
    K(1, 1) = this->between(0.8, 1.25) * K(0, 0);
    K(0, 1) = this->between(-0.02, 0.02) * K(0, 0);
    K(0, 2) = this->between(0.3, 0.7) * width;
    K(1, 2) = this->between(0.3, 0.7) * height;
    return K;
  }

  std::vector<double> draw(const CameraParameter& parameter, std::size_t wanted)
  {
    const std::vector<std::size_t>& counts = parameter.counts;
    const std::size_t any = counts[std::size_t(this->between(0, double(counts.size()) - 1e-9))];
    const bool list = counts != std::vector<std::size_t>{ 1 };
    std::vector<double> numbers(list && wanted > 0 ? wanted : any);
    const double usual = parameter.usual.empty() ? 1 : parameter.usual.front();
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      const double reach = list ? 0.3 / double(1 + i / 2) : std::max(1.0, 0.6 * usual); // of later coefficients, less
      const double least = std::max(parameter.range.least, usual - reach);
      const double most = std::min(parameter.range.most, usual + reach);
      do
      {
        numbers[i] = this->between(least, most);
      } while (!parameter.range.holds(numbers[i]));
    }
    return numbers;
  }

  std::mt19937_64 Random;
};

} // namespace dgtk::test

#endif
