// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovTurned_h
#define dgtkPovTurned_h

#include "dgtkPovText.h"

#include "dgtkSceneState.h"

#include <cstdint>
#include <map>
#include <string>

namespace dgtk
{

struct PovTextures;

// Where an interpolated normal faces away from the viewer although its triangle does not, POV-Ray turns it around and
// takes light for shadow and shadow for light; the built-in renderer keeps it. Light on the far side of the turned
// normal is light on the near side of the true one: there a finish that has only diffuse light from behind, `diffuse 0,
// d`, gives max(0, n . l) again, for all lights. A function of the place tells where, as the view sees it.

/// Triangle of a model -> function of x, y, z in the model's axes, which is 0 or more where the normal that shading
/// interpolates faces away from the viewer.
using PovTurned = std::map<std::uint32_t, std::string>;

/// The triangles of an instance in which such normals take more than 4 pixels of the image, hidden or not; more than 32
/// when other objects share its mesh.
PovTurned povTurned(const Instance& instance, const View& view, bool shared);

/// `#declare NAME = mesh2 { ... }`, with such triangles shaded by a finish of their own; its textures are declared as
/// NAME_0, NAME_1, ... then.
void povDeclareMesh(
  PovText& text, const std::string& name, const Instance& instance, PovTextures textures, const PovTurned& turned);

} // namespace dgtk

#endif
