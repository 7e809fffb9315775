// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDepthPicture_h
#define dgtkDepthPicture_h

#include <string>

namespace dgtk
{

/// The fixed mapping of the 8-bit depth picture: 0 where there is nothing, else 255 at `near` down to 1 at `far`, in
/// equal steps of log(depth); outside the range it stays at 255 or 1. With near <= 0 (orthographic cameras) in equal
/// steps of depth.
class DepthPicture
{
public:
  /// Throws UsageError naming `path` unless near < far, both finite.
  DepthPicture(double near, double far, const std::string& path);
  unsigned char operator()(double depth) const;

private:
  double Near;
  double Far;
  double Scale;
};

} // namespace dgtk

#endif
