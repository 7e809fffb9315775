// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDrawingRate_h
#define dgtkDrawingRate_h

#include "dgtkViewsModule.h"

#include <cstddef>
#include <deque>

namespace dgtk
{

/// How many triangles a view can draw fast enough, by the drawings before. A single slow one, on a busy machine, says
/// little: the best of the latest few counts, and any that is better than that counts at once.
class DGTKVIEWS_EXPORT DrawingRate
{
public:
  /// As many are always drawn, however long that takes.
  static constexpr std::size_t usualTriangles = 300000;

  /// A drawing with nothing that was not drawn before: no shaders compiled, no meshes sent to the graphics card.
  void add(std::size_t triangles, double seconds);
  /// For a drawing of 0.15 s; at least usualTriangles, and no limit while nothing is known.
  std::size_t mostTriangles() const;

private:
  double best() const;

  std::deque<double> Rates; ///< triangles a second, the latest last
};

} // namespace dgtk

#endif
