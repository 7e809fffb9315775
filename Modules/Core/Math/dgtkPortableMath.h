// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPortableMath_h
#define dgtkPortableMath_h

#include "dgtkCoreModule.h"

namespace dgtk
{
constexpr double pi = 3.14159265358979323846;
}

namespace dgtk::portable
{

// Elementary functions that give the same bits on every machine: only +, -, *, / and correctly rounded square roots,
// in a fixed order. (The C library chooses among variants by the processor, and their last bits differ.) Relative
// error below 1e-14 unless said otherwise.

/// Natural logarithm; x > 0, finite.
DGTKCORE_EXPORT double log(double x);
/// e^x; 0 below -700, that of 700 above.
DGTKCORE_EXPORT double exp(double x);
/// x^y; 0 for x <= 0.
DGTKCORE_EXPORT double pow(double x, double y);
/// Sine, cosine and tangent of x radians, arc sine and arc tangent in radians: the double that is nearest, but where
/// the value is within a thousandth of a step of the middle between two. For what is asked for once: computed in
/// extended precision, an order of magnitude slower than what follows.
DGTKCORE_EXPORT double sin(double x);
DGTKCORE_EXPORT double cos(double x);
DGTKCORE_EXPORT double tan(double x);
DGTKCORE_EXPORT double asin(double x);
DGTKCORE_EXPORT double atan(double x);
/// Arc cosine, radians, of c in [0, 1].
DGTKCORE_EXPORT double acos(double c);
/// Sine and cosine of x radians, |x| <= 1e5; absolute error below 1e-15.
struct SineCosine
{
  double sine;
  double cosine;
};
DGTKCORE_EXPORT SineCosine sinCos(double x);
/// Angle of the point (x, y), radians from -pi to pi; 0 for the origin.
DGTKCORE_EXPORT double atan2(double y, double x);
/// Logarithm of n!, n >= 0; absolute error below 1e-10 and a relative 1e-15.
DGTKCORE_EXPORT double logFactorial(double n);

/// sRGB (IEC 61966-2-1), both ways, on [0, 1]; values outside are clamped. Error below 1e-10.
DGTKCORE_EXPORT double linearFromSrgb(double v);
DGTKCORE_EXPORT double srgbFromLinear(double v);
/// The same of colours in single precision, whose curves go on above 1.
DGTKCORE_EXPORT float linearFromEncoded(float v);
DGTKCORE_EXPORT float encodedFromLinear(float v);

} // namespace dgtk::portable

#endif
