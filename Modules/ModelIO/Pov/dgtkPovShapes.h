// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovShapes_h
#define dgtkPovShapes_h

#include "dgtkPovMeshReader.h"

#include <set>

namespace dgtk
{

/// Reads the objects of a scene: meshes, groups of them, cameras, and what is not made of triangles.
class PovShapes
{
public:
  PovShapes(PovSession& session, PovAppearance& appearance)
    : Session(session)
    , Stream(session.stream)
    , Appearance(appearance)
    , Meshes(session, appearance)
  {
  }

  /// Reads one object of the scene or of a group; false, and nothing taken, when the next token does not begin one.
  bool item(PovShapeMaker& to);
  /// Reads the block after `camera`: the sign of the x of its `right`.
  double camera();

  /// Whether a word begins what is not made of triangles.
  static bool isOther(const PovToken& token);

  double right() const { return this->Right; } ///< of the last camera of the scene
  /// Statements that are no part of the model.
  const std::set<std::string>& scenery() const { return this->Scenery; }

private:
  PovShape group(const PovToken& word);
  PovShape object();
  PovShape named(const std::string& where);

  PovSession& Session;
  PovStream& Stream;
  PovAppearance& Appearance;
  PovMeshReader Meshes;
  std::set<std::string> Scenery;
  double Right = 1;
};

} // namespace dgtk

#endif
