// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRadialRays_h
#define dgtkRadialRays_h

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dgtk
{

/// What a point of the plane at distance r from the middle is multiplied by, and z, of the ray through it.
struct RadialRay
{
  double across;
  double z;
};

/// Rays of a lens that is the same all around, of r^2, by polynomials between points where they are known. Where these
/// do not follow to the last digits, as where a picture folds back, nothing is given.
class RadialRays
{
public:
  RadialRays() = default;
  /// Up to `most`. Function: RadialRay operator()(double r) const.
  template <class Function>
  RadialRays(const Function& function, double most)
    : PerUnit(pieces / (most * most))
    , Pieces(pieces)
  {
    for (int i = 0; i < pieces; ++i)
    {
      this->Pieces[std::size_t(i)] = fit([&](double u) { return function(std::sqrt((i + u) / this->PerUnit)); });
    }
  }

  /// False where a point's ray has to be computed.
  bool find(double square, RadialRay& ray) const
  {
    const double at = square * this->PerUnit;
    if (!(at < pieces))
    {
      return false;
    }
    const int i = static_cast<int>(at);
    const Piece& piece = this->Pieces[std::size_t(i)];
    ray = piece(at - i);
    return piece.holds;
  }

private:
  static constexpr int pieces = 256;
  static constexpr int points = 6;
  static constexpr double precision = 2e-15;
  /// Chebyshev's, of [0, 1].
  static constexpr std::array<double, points> places{ 0.017037086855465856, 0.14644660940672624, 0.37059047744873963,
    0.6294095225512604, 0.8535533905932737, 0.9829629131445341 };

  /// Newton's form.
  struct Piece
  {
    std::array<double, points> across;
    std::array<double, points> z;
    bool holds;
    RadialRay operator()(double u) const
    {
      RadialRay ray{ this->across[points - 1], this->z[points - 1] };
      for (int k = points - 2; k >= 0; --k)
      {
        ray = { this->across[std::size_t(k)] + (u - places[std::size_t(k)]) * ray.across,
          this->z[std::size_t(k)] + (u - places[std::size_t(k)]) * ray.z };
      }
      return ray;
    }
  };

  static void divide(std::array<double, points>& values)
  {
    for (std::size_t step = 1; step < points; ++step)
    {
      for (std::size_t k = points - 1; k >= step; --k)
      {
        values[k] = (values[k] - values[k - 1]) / (places[k] - places[k - step]);
      }
    }
  }

  template <class Function>
  static Piece fit(const Function& function)
  {
    Piece piece{};
    for (std::size_t k = 0; k < points; ++k)
    {
      const RadialRay ray = function(places[k]);
      piece.across[k] = ray.across;
      piece.z[k] = ray.z;
    }
    divide(piece.across);
    divide(piece.z);
    piece.holds = true;
    for (const double u : { 0.0, 0.08, 0.26, 0.5, 0.74, 0.92, 1.0 })
    {
      const RadialRay found = piece(u);
      const RadialRay exact = function(u);
      piece.holds = piece.holds && std::abs(found.across - exact.across) <= precision * std::abs(exact.across) &&
                    std::abs(found.z - exact.z) <= precision;
    }
    return piece;
  }

  double PerUnit = 0;
  std::vector<Piece> Pieces;
};

} // namespace dgtk

#endif
