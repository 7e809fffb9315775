// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSpaceNeeded_h
#define dgtkSpaceNeeded_h

// Private to Pipeline.

#include "dgtkWorkPlan.h"

#include <cstdint>
#include <string>

namespace dgtk
{

/// Bytes of the files of a run.
struct SpaceNeeded
{
  std::uint64_t least = 0;  ///< it cannot be less
  std::uint64_t likely = 0; ///< of pictures as they usually are
};

/// Of one image. Formats that do not hold every pixel of an image are not counted.
SpaceNeeded spaceOf(const LayerSpec& spec, const std::string& format, int width, int height);

/// Of a whole run.
SpaceNeeded spaceOf(const WorkPlan& plan, const Stage& stage);

/// What a folder offers to a run that takes the place of what is in it.
struct SpaceFree
{
  std::uint64_t bytes = 0;
  bool exact = true; ///< false where the file system may compress
};

/// Of the folder, or of where it is going to be made. What stands in it is counted only where the rest is not `enough`.
SpaceFree spaceIn(const std::string& folder, std::uint64_t enough);

/// Throws MachineError when a run cannot fit; a line when it may not; empty when all is well.
std::string checkSpace(const std::string& folder, const SpaceNeeded& needed, const SpaceFree& free);

} // namespace dgtk

#endif
