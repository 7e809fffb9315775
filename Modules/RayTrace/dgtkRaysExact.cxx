// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayScene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
/// Where a ray enters boxes of a frame that `place` takes to the ray's, as far as double precision can tell.
class BoxEntry
{
public:
  BoxEntry(const ExactRay& ray, const Affine3& place, const Eigen::AlignedBox3d& all, const double& most)
    : Place(place.linear)
    , Size(0.5 * place.linear.cwiseAbs())
    , Way(place.translation - ray.origin)
    , Inverse(ray.direction.cwiseInverse())
    , Noise(1e-14 * (place.translation.norm() + ray.origin.norm() +
                      place.linear.norm() * (all.center().norm() + all.sizes().norm())))
    , Least(ray.least * (1 - 1e-12))
    , Most(most)
  {
  }
  double operator()(const Eigen::AlignedBox3d& box) const
  {
    const Eigen::Vector3d centre = this->Place * box.center() + this->Way;
    const Eigen::Vector3d size = (this->Size * box.sizes()).array() + this->Noise;
    double low = this->Least;
    double high = this->Most;
    for (int i = 0; i < 3; ++i)
    {
      const double a = (centre[i] - size[i]) * this->Inverse[i];
      const double b = (centre[i] + size[i]) * this->Inverse[i];
      low = std::max(low, a < b ? a : b); // what is no number is passed over
      high = std::min(high, a < b ? b : a);
    }
    return low <= high * (1 + 1e-12) ? low : std::numeric_limits<double>::infinity();
  }

private:
  Eigen::Matrix3d Place;
  Eigen::Matrix3d Size;
  Eigen::Vector3d Way;
  Eigen::Vector3d Inverse;
  double Noise; ///< of corners
  double Least;
  const double& Most;
};
} // namespace

const BoxTree& RayScene::exactTree() const
{
  std::call_once(this->Exact->once,
    [this]
    {
      std::vector<Eigen::AlignedBox3d> boxes(this->Instances.size());
      for (std::size_t i = 0; i < boxes.size(); ++i)
      {
        const Placed& placed = this->Instances[i];
        const Eigen::AlignedBox3d own = placed.mesh ? placed.mesh->tree().box() : Eigen::AlignedBox3d();
        if (!own.isEmpty())
        {
          const Eigen::Vector3d centre = placed.camera_from_object * own.center();
          const Affine3& place = placed.camera_from_object;
          const double noise =
            1e-14 * (place.translation.norm() + place.linear.norm() * (own.center().norm() + own.sizes().norm()));
          const Eigen::Vector3d half = (0.5 * place.linear.cwiseAbs() * own.sizes()).array() + noise;
          boxes[i] = { centre - half, centre + half };
        }
      }
      this->Exact->boxes = BoxTree(boxes);
    });
  return this->Exact->boxes;
}

void sortHits(std::vector<RayHit>& hits)
{
  const auto lower = [](const RayHit& a, const RayHit& b)
  { return a.hit.object != b.hit.object ? a.hit.object < b.hit.object : a.hit.triangle < b.hit.triangle; };
  std::sort(
    hits.begin(), hits.end(), [&](const RayHit& a, const RayHit& b) { return a.t != b.t ? a.t < b.t : lower(a, b); });
  for (auto first = hits.begin(); first != hits.end();)
  {
    const double limit = first->t + sameDistance * std::abs(first->t);
    const auto last = std::find_if(first, hits.end(), [&](const RayHit& h) { return h.t > limit; });
    std::sort(first, last, lower);
    first = last;
  }
}

void RayScene::collectExactly(const ExactRay& ray, bool nearest, std::vector<RayHit>& hits) const
{
  hits.clear();
  if (!isTraceable(ray.origin, ray.direction))
  {
    return;
  }
  double most = ray.most;
  const BoxTree& all = this->exactTree();
  all.walk(most, BoxEntry(ray, {}, all.box(), most),
    [&](std::uint32_t instance)
    {
      const Placed& placed = this->Instances[instance];
      const BoxTree& tree = placed.mesh->tree();
      tree.walk(most, BoxEntry(ray, placed.camera_from_object, tree.box(), most),
        [&](std::uint32_t triangle)
        {
          const Hit hit{ instance + 1, triangle };
          const ExactHit exactly = this->intersect(ray, hit);
          if (exactly.inside)
          {
            hits.push_back({ exactly.t, hit });
            most = nearest ? std::min(most, exactly.t + sameDistance * std::abs(exactly.t)) : most;
          }
        });
    });
  sortHits(hits);
}

} // namespace dgtk
