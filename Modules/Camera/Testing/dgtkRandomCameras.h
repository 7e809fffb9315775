// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRandomCameras_h
#define dgtkRandomCameras_h

#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <algorithm>
#include <cmath>
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
      if (parameter.kind == CameraParameter::Kind::File)
      {
        of.files[parameter.name] = this->writeRays();
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

  /// A table of the rays of an equidistant fisheye with some lens's aberrations; half of them from one point, some with
  /// nothing around a circle.
  std::string writeRays()
  {
    const int rows = int(this->between(9, 60));
    const int columns = int(this->between(9, 60));
    const bool fromOnePoint = this->between(0, 1) < 0.5;
    const double widest = this->between(0.4, 2.2);
    const double aberration = this->between(0, 1e-3); // rays cross as near
    std::vector<double> numbers;
    for (int i = 0; i < rows * columns; ++i)
    {
      const double x = (i % columns + 0.5) / columns * 2 - 1;
      const double y = (i / columns + 0.5) / rows * 2 - 1; // NOLINT: of the row
      const double radius = std::hypot(x, y);
      const double angle = radius > 1.05 ? std::nan("") : widest * radius;
      const double across = std::sin(angle) / std::max(radius, 1e-9);
      const std::vector<double> origin{ aberration * x * y, aberration * x, aberration * radius };
      numbers.insert(numbers.end(), origin.begin(), fromOnePoint ? origin.begin() : origin.end());
      for (const double v : { across * x, across * y * 1.02, std::cos(angle) })
      {
        numbers.push_back(2.5 * v);
      }
    }
    std::string path = this->Folder.path(std::to_string(++this->Files) + ".npy");
    writeNpy(path, rows, columns, fromOnePoint ? 3 : 6, numbers);
    return path;
  }

  static void writeNpy(const std::string& path, int rows, int columns, int channels, const std::vector<double>& numbers)
  {
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                         std::to_string(columns) + ", " + std::to_string(channels) + "), }";
    header.resize(117, ' ');
    header += '\n';
    std::string file("\x93NUMPY\x01\x00v\x00", 10);
    file += header;
    file.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
    writeFile(path, file);
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
  TemporaryFolder Folder;
  int Files = 0;
};

} // namespace dgtk::test

#endif
