// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDrawnBand_h
#define dgtkDrawnBand_h

// Private to Pipeline.

#include "dgtkBand.h"

#include <functional>
#include <mutex>

namespace dgtk
{

/// A band as drawing leaves it.
class DrawnBand
{
public:
  Band band;
  std::function<void()> complete = [] {}; ///< to be done until `band` is whole; waits for no other job

  std::function<void()> fetchColor = [] {}; ///< to be done until Band::rgb is there, where that takes longer

  /// Completes it when it is called first, in whichever thread. With `colored`, Band::rgb is there as well.
  const Band& whole(bool colored = true)
  {
    std::call_once(this->Once, this->complete);
    if (colored)
    {
      std::call_once(this->ColorOnce, this->fetchColor);
    }
    return this->band;
  }

private:
  std::once_flag Once;
  std::once_flag ColorOnce;
};

} // namespace dgtk

#endif
