// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlaceWorld_h
#define dgtkPlaceWorld_h

#include "dgtkPlaceBody.h"
#include "dgtkPlaceRule.h"

#include <cstddef>
#include <vector>

namespace dgtk
{

/// The bodies of a scene: one for each object without a parent, with what hangs on it, at the scene's first frame.
/// Objects that are never visible are not there. Bodies with a rule are out until they are put somewhere.
class PlaceWorld
{
public:
  PlaceWorld(const SceneDescription& scene, const std::vector<PlaceRule>& rules, SampleModels& models);

  /// Of an object without a parent.
  PlaceBody& body(std::size_t object) { return this->Bodies[this->BodyOf[object]]; }
  void putIn(std::size_t object) { this->In[this->BodyOf[object]] = 1; }
  void takeOut(std::size_t object) { this->In[this->BodyOf[object]] = 0; }
  /// All bodies that are in, but for some objects'.
  std::vector<const PlaceBody*> others(const std::vector<std::size_t>& but) const;

  Eigen::Vector3d up() const { return Eigen::Vector3d::Unit(this->Up); }
  /// The axes that are not up.
  std::array<int, 2> level() const { return { 0, this->Up == 1 ? 2 : 1 }; }
  int upAxis() const { return this->Up; }
  double tolerance(const PlaceRule& rule)
  {
    return rule.tolerance ? *rule.tolerance : 0.005 * this->body(rule.object).size();
  }

private:
  std::vector<PlaceBody> Bodies;
  std::vector<std::size_t> BodyOf; ///< object without a parent -> body
  std::vector<char> In;
  int Up = 1;
};

/// Deepest penetration of a body into others, and its way down to the nearest of them, at most `most`.
struct PlaceMeasure
{
  double penetration = 0;
  double gap = 0;
};
PlaceMeasure measurePlace(
  const PlaceBody& body, const std::vector<const PlaceBody*>& others, const Eigen::Vector3d& down, double most);

/// Moves a body out of others and then down onto them, where they are nearer than `most`: what hulls and margins left
/// between the true meshes.
void layDown(PlaceBody& body, const std::vector<const PlaceBody*>& others, const Eigen::Vector3d& down, double most);

/// Whether a body that lies on another is held below its middle: the middle is within the polygon of what touches.
bool stands(const PlaceBody& body, const PlaceBody& support, const Eigen::Vector3d& down, double tolerance);

} // namespace dgtk

#endif
