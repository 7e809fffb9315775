// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExactSide.h"

#include "dgtkDoubleDouble.h"

#include <array>
#include <cstddef>

namespace dgtk
{

namespace
{
/// A sum of doubles as an expansion: parts that do not overlap, the largest last. Shewchuk, "Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997), Grow-Expansion.
class ExactSum
{
public:
  void add(double value)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      const DoubleDouble sum = twoSum(value, this->Parts[i]);
      value = sum.hi;
      if (sum.lo != 0)
      {
        this->Parts[kept++] = sum.lo;
      }
    }
    this->Count = kept;
    if (value != 0)
    {
      this->Parts[this->Count++] = value;
    }
  }
  void add(const DoubleDouble& product)
  {
    this->add(product.lo);
    this->add(product.hi);
  }
  int sign() const { return this->Count == 0 ? 0 : this->Parts[this->Count - 1] > 0 ? 1 : -1; }

private:
  std::array<double, 24> Parts; // of six products of three numbers
  std::size_t Count = 0;
};
} // namespace

int exactSide(const Eigen::Vector3d& direction, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  ExactSum all;
  ExactSum component[3];
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    for (const DoubleDouble& product : { twoProduct(a[j], b[k]), twoProduct(-a[k], b[j]) })
    {
      component[i].add(product);
      all.add(twoProduct(direction[i], product.lo));
      all.add(twoProduct(direction[i], product.hi));
    }
  }
  for (const ExactSum& sum : { all, component[0], component[1], component[2] })
  {
    if (sum.sign() != 0)
    {
      return sum.sign();
    }
  }
  return 0;
}

} // namespace dgtk
