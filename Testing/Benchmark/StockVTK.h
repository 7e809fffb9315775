// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStockVTK_h
#define dgtkStockVTK_h

#include "dgtkSceneState.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk::bench
{

/// The reference of the benchmarks: VTK as it comes, drawing a scene state into a window of the same kind (EGL,
/// software).
class StockVTK
{
public:
  StockVTK(const SceneState& state, int width, int height);
  ~StockVTK();

  /// One colour render, complete when it returns.
  void render(const View& view);

  /// What VTK offers for the work of DGTk's colour, depth and ids: window-to-image, z-buffer read-back turned into
  /// depth, and vtkHardwareSelector for actors and cells. Call after render().
  struct Truth
  {
    std::vector<unsigned char> rgb;     ///< rows bottom to top
    std::vector<double> depth;          ///< from the z-buffer
    std::vector<unsigned int> object;   ///< actor + 1, 0 background
    std::vector<unsigned int> triangle; ///< cell
  };
  void capture(const View& view, Truth& truth);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk::bench

#endif
