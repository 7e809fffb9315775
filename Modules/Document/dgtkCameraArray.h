// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraArray_h
#define dgtkCameraArray_h

#include "dgtkDocumentModule.h"

#include "dgtkSceneDescription.h"

#include <vector>

namespace dgtk
{

enum class CameraArrayKind
{
  Ring,       ///< evenly on a circle about the up axis through `lookAt`, at the eye's distance and height
  Hemisphere, ///< evenly over the upper half of the sphere about `lookAt` through the eye (Fibonacci's spiral)
  Grid,       ///< parallel views, `columns` x `rows`, `spacing` apart in the image plane, the eye in the middle
  Stereo,     ///< two parallel views, `spacing` apart along the image's x axis, the eye in the middle; left first
  Path        ///< evenly by length along the segments between the points of `path`, both ends included
};

// What a kind asks for beside lens and look-at point.
constexpr bool isCounted(CameraArrayKind kind)
{
  return kind != CameraArrayKind::Grid && kind != CameraArrayKind::Stereo;
}
constexpr bool isSpaced(CameraArrayKind kind) { return !isCounted(kind); }

/// Where cameras go by, and where they look there.
struct CameraPath
{
  std::vector<Eigen::Vector3d> eyes;
  std::vector<Eigen::Vector3d> targets; ///< as many as eyes
};

/// Eye and look-at point at each key frame of a camera; of a posed one a point before it. Empty without key frames.
DGTKDOCUMENT_EXPORT CameraPath keyFramePath(const CameraDescription& camera);

struct CameraArrayOptions
{
  CameraArrayKind kind = CameraArrayKind::Ring;
  CameraDescription first; ///< pose by eye, lookAt, up; lens, size, near and far are those of all; names begin with its
  int count = 8;           ///< Ring, Hemisphere, Path: >= 1
  CameraPath path;         ///< Path: at least two points, not all the same
  int columns = 3;         ///< Grid: >= 1
  int rows = 3;            ///< Grid: >= 1
  double spacing = 0.1;    ///< scene units, > 0
};

/// The cameras, named <name>-1, <name>-2, ... (Stereo: <name>-left, <name>-right). Throws UsageError for values of its
/// kind out of their range, and for an eye at its look-at point or looking along `up`.
DGTKDOCUMENT_EXPORT std::vector<CameraDescription> cameraArray(const CameraArrayOptions& options);

} // namespace dgtk

#endif
