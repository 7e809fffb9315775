// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraWalk_h
#define dgtkCameraWalk_h

#include "dgtkCameraPath.h"
#include "dgtkJson.h"

#include <string>

namespace dgtk
{

/// A walk at random that keeps its distance from all surfaces, see bakedPath(); `path`: of its draws.
TravelledPath walkedPath(const JsonCursor& at, const std::string& path, SampleWorld& world, UpAxis up,
  const SampleDraws& draws, std::uint32_t attempt, bool looks);

} // namespace dgtk

#endif
