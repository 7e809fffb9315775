// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSparseCorrespondence.h"

#include "dgtkRaySource.h"

namespace dgtk
{

std::vector<SparseMatch> correspondPoints(
  const Stage& stage, const SparseRequest& request, const std::vector<Eigen::Vector2d>& points)
{
  const auto stateFrom = stage.at(request.fromFrame);
  const auto stateTo = request.toFrame == request.fromFrame ? stateFrom : stage.at(request.toFrame);
  const View view = stage.view(request.fromCamera, request.fromFrame, request.width, request.height);
  const auto first = makeOcclusionQuery();
  first->setScene(stateFrom);
  const auto second = makeOcclusionQuery();
  second->setScene(stateTo);
  const OtherView other{ stateTo.get(), stage.view(request.toCamera, request.toFrame, request.width, request.height),
    second.get() };
  std::vector<SparseMatch> matches;
  for (const Eigen::Vector2d& point : points)
  {
    SparseMatch match;
    match.from = point;
    match.to = correspondPixel(*stateFrom, view, *first, point, other, &match.hit);
    matches.push_back(match);
  }
  return matches;
}

} // namespace dgtk
