// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRepresentation_h
#define dgtkRepresentation_h

#include "dgtkGroundTruthModule.h"

#include "dgtkLayer.h"
#include "dgtkSurfaceRows.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A layer derived pixel by pixel from the visibility buffer. Stateless and thread-safe. One class a file, hidden in
/// its .cxx; one row `dgtk_representation(...)` in CMakeLists.txt registers it.
class DGTKGROUNDTRUTH_EXPORT Representation
{
public:
  virtual ~Representation() = default;
  virtual LayerSpec spec() const = 0;
  /// File formats (writer names), the first is the default: {"npy", "exr"}.
  virtual std::vector<std::string> formats() const = 0;
  /// Whether compute() reads SurfaceRows::barycentrics.
  virtual bool needsBarycentrics() const { return false; }
  /// The largest value, that for nothing apart, of a uint32 layer in any picture of the state; 0 for other layers.
  virtual std::uint32_t largest(const SceneState&) const { return 0; }
  /// Fills `out`, which has the spec's type and channels and the rows of `in`.
  virtual void compute(const SurfaceRows& in, Rows& out) const = 0;
};

struct RepresentationInfo
{
  std::string name;        ///< "Depth"
  std::string layer;       ///< "depth"
  std::string description; ///< one sentence
  bool usual;              ///< taken where no layers are asked for
};
/// All representations, in the order of their rows in CMakeLists.txt.
DGTKGROUNDTRUTH_EXPORT const std::vector<RepresentationInfo>& representations();
/// The representation of a layer. Throws UsageError for an unknown one.
DGTKGROUNDTRUTH_EXPORT std::unique_ptr<Representation> makeRepresentation(const std::string& layer);

/// Class id of each object of a state: the one that the scene fixes, else from 1 in the order in which the classes
/// first appear; objects without a class share the class of the empty name.
DGTKGROUNDTRUTH_EXPORT std::vector<std::uint32_t> classIds(const SceneState& state);

} // namespace dgtk

#endif
