// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEmptyLane_h
#define dgtkEmptyLane_h

#include "dgtkFrameOutput.h"

namespace dgtk
{

/// The lane of a layer whose files another layer's lane writes.
class EmptyLane : public OutputLane
{
public:
  void write(const Band&) override {}
  std::vector<FinishedFile> finish() override { return {}; }
};

} // namespace dgtk

#endif
