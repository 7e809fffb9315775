// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneEdits_h
#define dgtkSceneEdits_h

#include "dgtkDocumentModule.h"

#include "dgtkSceneDescription.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace dgtk
{

// What an editor does to a description. None of these validates; SceneDocument does, once for each edit.

using SceneItems = std::vector<SceneItem>;

/// Changes a track at a frame: its key there, or a new key of a track that has keys, or the value of one that has none.
/// A new key goes on in the way of the key before it.
template <typename T>
void setTrackAt(Track<T>& track, int frame, const T& value)
{
  if (!track.animated())
  {
    track.value = value;
    return;
  }
  const auto at = std::lower_bound(
    track.keys.begin(), track.keys.end(), frame, [](const Key<T>& key, int f) { return key.frame < f; });
  if (at != track.keys.end() && at->frame == frame)
  {
    at->value = value;
  }
  else
  {
    const auto way = at == track.keys.begin() ? std::nullopt : std::prev(at)->interpolation;
    track.keys.insert(at, Key<T>{ frame, value, way });
  }
}

/// The value at a frame as pictures have it: numbers and colours stay within their keys where a smooth curve does not.
template <typename T>
T valueAt(const Track<T>& track, int frame, bool color)
{
  if constexpr (std::is_same_v<T, double>)
  {
    return boundedAt(track, frame);
  }
  else if constexpr (std::is_same_v<T, Eigen::Vector3d>)
  {
    return color ? boundedAt(track, frame) : track.at(frame);
  }
  else
  {
    return track.at(frame);
  }
}

DGTKDOCUMENT_EXPORT std::string itemName(const SceneDescription& scene, const SceneItem& item);
/// Also where children name it as their parent.
DGTKDOCUMENT_EXPORT void renameItem(SceneDescription& scene, const SceneItem& item, const std::string& name);

/// Where an item is at a frame: an object's position in its parent's frame, a light's position, a camera's centre.
DGTKDOCUMENT_EXPORT Eigen::Vector3d itemPosition(const SceneDescription& scene, const SceneItem& item, double frame);
/// Cameras with a look-at point take it along, lights with a direction their target.
DGTKDOCUMENT_EXPORT void setItemPosition(
  SceneDescription& scene, const SceneItem& item, int frame, const Eigen::Vector3d& position);

/// Appends a copy of everything of `from`, with paths made relative to the folder of `scene` and names made unique.
/// Returns the new items. Both folders must be absolute where they differ.
DGTKDOCUMENT_EXPORT SceneItems appendItems(SceneDescription& scene, const SceneDescription& from);
/// `items`, and after them the objects that hang on those of `items`.
DGTKDOCUMENT_EXPORT SceneItems withChildren(const SceneDescription& scene, SceneItems items);
/// A description of the folder of `scene` with nothing but these items; parents outside of them stay named.
DGTKDOCUMENT_EXPORT SceneDescription extractItems(const SceneDescription& scene, const SceneItems& items);
/// Removes items, and the children of removed objects.
DGTKDOCUMENT_EXPORT void removeItems(SceneDescription& scene, const SceneItems& items);

/// Gives every position, orientation and scale of objects, position of lights and pose of cameras a key at a frame,
/// with the value that it has there.
DGTKDOCUMENT_EXPORT void makeKeyFrame(SceneDescription& scene, int frame);
/// Removes the keys of a frame from all tracks. A track that loses its last key keeps that value.
DGTKDOCUMENT_EXPORT void removeKeyFrame(SceneDescription& scene, int frame);
/// Gives another frame the keys of a frame, in place of those that are there; tracks without a key there stay as they
/// are. A key keeps its kind of interpolation.
DGTKDOCUMENT_EXPORT void copyKeyFrame(SceneDescription& scene, int from, int to);
/// As copyKeyFrame(), and the keys leave `from`.
DGTKDOCUMENT_EXPORT void moveKeyFrame(SceneDescription& scene, int from, int to);
/// The same for the keys of one item.
DGTKDOCUMENT_EXPORT void copyItemKeys(SceneDescription& scene, const SceneItem& item, int from, int to);
DGTKDOCUMENT_EXPORT void moveItemKeys(SceneDescription& scene, const SceneItem& item, int from, int to);
DGTKDOCUMENT_EXPORT void removeItemKeys(SceneDescription& scene, const SceneItem& item, int frame);
/// How the keys of an item at a frame go to the next ones; none: as the item's other keys.
DGTKDOCUMENT_EXPORT void setKeyInterpolation(
  SceneDescription& scene, const SceneItem& item, int frame, std::optional<Interpolation> interpolation);
/// What the first track with a key there does, and whether it is the key's own; none without a key.
struct KeyInterpolation
{
  Interpolation kind = Interpolation::Linear;
  bool own = false;
};
DGTKDOCUMENT_EXPORT std::optional<KeyInterpolation> keyInterpolationOf(
  const SceneDescription& scene, const SceneItem& item, int frame);
/// How the tracks of an item that have keys go from one to the next; no key has a kind of its own then.
DGTKDOCUMENT_EXPORT void setInterpolation(SceneDescription& scene, const SceneItem& item, Interpolation interpolation);
/// That of the first track with keys; Linear without any.
DGTKDOCUMENT_EXPORT Interpolation interpolationOf(const SceneDescription& scene, const SceneItem& item);
/// Frames at which an item has keys, ascending.
DGTKDOCUMENT_EXPORT std::vector<int> keyFramesOf(const SceneDescription& scene, const SceneItem& item);

} // namespace dgtk

#endif
