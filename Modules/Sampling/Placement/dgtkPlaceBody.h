// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlaceBody_h
#define dgtkPlaceBody_h

#include "dgtkRigid3.h"
#include "dgtkSolidModel.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A mesh, for the triangles near a point or within a box. Immutable.
class TriangleTree
{
public:
  TriangleTree(const SolidMesh& mesh, std::size_t first, std::size_t count);

  /// Whether a ray from a point crosses it an odd number of times.
  bool holds(const Eigen::Vector3d& x) const;
  /// The nearest point of it.
  Eigen::Vector3d nearest(const Eigen::Vector3d& x) const;
  /// Calls visit(triangle of the mesh) for all whose boxes meet a box.
  template <typename Visit>
  void within(const Eigen::AlignedBox3d& box, const Visit& visit) const
  {
    this->visit(
      0, [&box](const Eigen::AlignedBox3d& node) { return node.intersects(box); }, visit);
  }

private:
  struct Node
  {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0; ///< of Order; of an inner node the right child, the left one is the next node
    std::uint32_t count = 0; ///< 0: an inner node
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  template <typename Meets, typename Visit>
  void visit(std::uint32_t at, const Meets& meets, const Visit& visit) const
  {
    const Node& node = this->Nodes[at];
    if (!meets(node.box))
    {
      return;
    }
    if (node.count == 0)
    {
      this->visit(at + 1, meets, visit);
      this->visit(node.first, meets, visit);
    }
    for (std::uint32_t i = 0; i < node.count; ++i)
    {
      visit(this->Order[node.first + i]);
    }
  }
  Eigen::AlignedBox3d boxOf(std::uint32_t triangle) const;

  const SolidMesh& Mesh;
  std::vector<std::uint32_t> Order;
  std::vector<Node> Nodes;
};

/// What moves as one: an object with all that hangs on it. Its frame is the object's without its scale.
class PlaceBody
{
public:
  struct Parameters
  {
    std::string name;
    std::shared_ptr<const SolidMesh> mesh; ///< body frame, to scale; may be without triangles
    std::vector<ConvexHull> pieces;        ///< of what falls
    Rigid3 world_from_body;
  };
  explicit PlaceBody(Parameters parameters);
  ~PlaceBody();
  PlaceBody(PlaceBody&&) noexcept;

  const std::string& name() const { return this->Is.name; }
  const SolidMesh& mesh() const { return *this->Is.mesh; }
  const std::vector<ConvexHull>& pieces() const { return this->Is.pieces; }
  const Rigid3& pose() const { return this->Is.world_from_body; }
  void setPose(const Rigid3& world_from_body);
  void move(const Eigen::Vector3d& by_in_world);
  /// Largest side of its box in the body frame.
  double size() const { return this->Size; }
  Eigen::Vector3d middle() const { return this->Is.world_from_body * this->Bounds.center(); }
  const Eigen::AlignedBox3d& box() const { return this->WorldBox; }                ///< world frame
  const std::vector<Eigen::Vector3d>& points() const { return this->WorldPoints; } ///< world frame

  struct Impl;
  Impl& impl() const { return *this->Self; }

private:
  Parameters Is;
  Eigen::AlignedBox3d Bounds;
  double Size = 0;
  Eigen::AlignedBox3d WorldBox;
  std::vector<Eigen::Vector3d> WorldPoints;
  std::unique_ptr<Impl> Self;
};

/// How far two bodies are in each other: the largest of the depth of a vertex of one below the surface of a closed part
/// of the other, and of the ways by which two crossing triangles must move apart.
struct Penetration
{
  double depth = 0;
  Eigen::Vector3d out{ 0, 0, 0 }; ///< unit vector: the first body leaves the second that way
};
Penetration penetration(const PlaceBody& a, const PlaceBody& b);

/// Whether bodies are in each other that penetration() finds apart, as sides of theirs lie in one plane: points just
/// below the surface of a closed part of one are in such a part of the other, or open surfaces lie on one another.
/// `touch`: how much is just below, and on.
bool coincide(const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double touch);

/// Least distance between the surfaces; 0 where they cross. Larger ones than `most` may come out as `most`.
double distance(const PlaceBody& a, const PlaceBody& b, double most);

/// How far `a` can move along the unit vector `down` before it meets `b`, at most `most`; 0 where a is up to `depth` in
/// it already, along that way.
double wayDown(const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double most, double depth);

/// Where bodies touch when one comes down on the other, to `tolerance` along that way: points of the first.
std::vector<Eigen::Vector3d> touches(
  const PlaceBody& a, const PlaceBody& b, const Eigen::Vector3d& down, double tolerance);

} // namespace dgtk

#endif
