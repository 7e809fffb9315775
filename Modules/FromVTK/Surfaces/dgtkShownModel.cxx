// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShownModel.h"

#include <cmath>

namespace dgtk
{

namespace
{
double sideOf(const Eigen::Vector4d& plane, const Eigen::Vector3d& point)
{
  return plane.head<3>().dot(point) + plane[3];
}

/// Copies triangles and what is left of them.
class Cutter
{
public:
  Cutter(const Model& from, const ShownSurface& shown)
    : From(from)
    , Rest(*from.rest)
    , Shown(shown)
    , To(std::make_shared<Model>(from))
    , Points(std::make_shared<Geometry>(*from.rest))
  {
    this->To->triangles.clear();
    this->To->unplaced.clear();
    this->To->parts.clear();
  }

  ShownModel run()
  {
    for (const Part& part : this->From.parts)
    {
      Part kept = part;
      kept.firstTriangle = std::uint32_t(this->To->triangles.size());
      for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
      {
        this->cut(t);
      }
      kept.triangles = std::uint32_t(this->To->triangles.size()) - kept.firstTriangle;
      if (kept.triangles > 0)
      {
        this->To->parts.push_back(kept);
      }
    }
    this->keepPlace();
    this->setPlaced();
    this->To->rest = this->Points;
    return { this->To, std::move(this->Parents) };
  }

private:
  /// A model without triangles has no id: one without area, which nothing meets, holds it.
  void keepPlace()
  {
    if (this->To->triangles.empty())
    {
      this->To->triangles.push_back({ 0, 0, 0 });
      this->To->parts.push_back({ this->From.parts.front().name, this->From.parts.front().material, 0, 1 });
      this->Parents.push_back(0);
    }
  }

  void setPlaced()
  {
    if (!this->From.unplaced.empty())
    {
      for (const std::uint32_t parent : this->Parents)
      {
        this->To->unplaced.push_back(this->From.unplaced[parent]);
      }
    }
  }

  void cut(std::uint32_t triangle)
  {
    const auto& corners = this->From.triangles[triangle];
    const Eigen::Vector3d p[3] = { this->Rest.positions[corners[0]], this->Rest.positions[corners[1]],
      this->Rest.positions[corners[2]] };
    if (this->Shown.isCulled && this->Shown.isCulled(p))
    {
      return;
    }
    std::vector<std::uint32_t> polygon(corners.begin(), corners.end());
    for (const Eigen::Vector4d& plane : this->Shown.planes)
    {
      polygon = this->below(polygon, plane);
    }
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
      this->To->triangles.push_back({ polygon[0], polygon[i], polygon[i + 1] });
      this->Parents.push_back(triangle);
    }
  }

  std::vector<std::uint32_t> below(const std::vector<std::uint32_t>& polygon, const Eigen::Vector4d& plane)
  {
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const std::uint32_t a = polygon[i];
      const std::uint32_t b = polygon[(i + 1) % polygon.size()];
      const double sideA = sideOf(plane, this->Points->positions[a]);
      const double sideB = sideOf(plane, this->Points->positions[b]);
      if (sideA >= 0)
      {
        left.push_back(a);
      }
      if ((sideA > 0 && sideB < 0) || (sideA < 0 && sideB > 0))
      {
        left.push_back(this->between(a, b, sideA / (sideA - sideB)));
      }
    }
    return left;
  }

  std::uint32_t between(std::uint32_t a, std::uint32_t b, double part)
  {
    const auto made = std::uint32_t(this->Points->positions.size());
    const auto mixed = [part](const auto& from, const auto& to) { return (from + part * (to - from)).eval(); };
    std::vector<Eigen::Vector3d>& p = this->Points->positions;
    p.push_back(mixed(p[a], p[b]));
    std::vector<Eigen::Vector3f>& n = this->Points->normals;
    const Eigen::Vector3f normal = n[a] + float(part) * (n[b] - n[a]);
    n.push_back(normal.isZero(0) ? n[a] : normal); // shorter than 1: it goes on as on the whole triangle
    Model& to = *this->To;
    to.sourceVertex.push_back(made);
    to.sourceVertices = made + 1;
    for (auto* const pairs : { &to.uvs, &to.colorMapAt })
    {
      if (!pairs->empty())
      {
        pairs->push_back(mixed((*pairs)[a], (*pairs)[b]));
      }
    }
    if (!to.colors.empty())
    {
      auto color = to.colors[a];
      for (std::size_t c = 0; c < color.size(); ++c)
      {
        color[c] = std::uint8_t(std::lround(color[c] + part * (to.colors[b][c] - color[c])));
      }
      to.colors.push_back(color);
    }
    return made;
  }

  const Model& From;
  const Geometry& Rest;
  const ShownSurface& Shown;
  std::shared_ptr<Model> To;
  std::shared_ptr<Geometry> Points;
  std::vector<std::uint32_t> Parents;
};
} // namespace

ShownModel shownModel(const std::shared_ptr<const Model>& model, const ShownSurface& shown)
{
  return shown.isAll() ? ShownModel{ model, {} } : Cutter(*model, shown).run();
}

} // namespace dgtk
