// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovExport_h
#define dgtkPovExport_h

#include "dgtkSceneExportModule.h"

#include "dgtkSceneState.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// A box of the world, scene units.
struct PovBox
{
  Eigen::Vector3d low{ 0, 0, 0 };
  Eigen::Vector3d high{ 1, 1, 1 };
};

/// A lens.
struct PovLens
{
  double aperture = 0; ///< diameter, scene units, > 0
  double focus = 1;    ///< distance of the plane in focus from the camera, scene units, > 0
};

struct PovOptions
{
  /// Every object in one colour without light: R, G, B are its id as a 24-bit number, R high, as in the layer objects.
  bool flatIds = false;
  /// Every surface shines in the colour of its place in the world: (x - low) / (high - low). Surfaces outside the box
  /// have colours that mean nothing; missing texels are drawn. Not with flatIds.
  std::optional<PovBox> positionColors;
  /// Objects cast shadows. Off, as in the built-in renderer.
  bool shadows = false;
  /// Lights have the width of a tenth of the scene's radius, sampled at N x N points; 0: points. Needs shadows.
  int areaLights = 0;
  bool reflections = false;       ///< shiny materials reflect
  bool radiosity = false;         ///< light between surfaces in place of the ambient light
  std::optional<PovLens> lens;    ///< focal blur
  int antialias = 1;              ///< points a pixel and axis in the options of the second line, 1 to 9
  std::optional<double> ownScale; ///< how much larger the scene is written; none: see PovResult::scale
  /// Files that exportPov() may not overwrite, besides those of the models: those of Stage::inputFiles().
  std::vector<std::string> inputs;
};

/// What was written.
struct PovResult
{
  std::vector<std::string> files;    ///< textures in the order of their first use, then the scene
  std::vector<std::string> warnings; ///< what POV-Ray will show otherwise than the built-in renderer, one line each
  /// How much larger than the scene it is written, camera and lights included: a power of two that brings it to the
  /// size at which POV-Ray's fixed tolerances are small against it and its largest distance is not reached.
  double scale = 1;
};

/// Writes a state of a scene, seen by a camera, for POV-Ray 3.7 (Documentation/Formats/pov.md). Coordinates are the
/// world's, times PovResult::scale. Each mesh is declared once, however many instances have it. Textures that POV-Ray
/// would read otherwise are written beside the scene as <stem>_<number>.ppm, those with missing texels with a mask
/// .pgm; a number under which an input stands is left out. All files appear when they are whole, the scene last. Throws
/// UsageError for a camera that is not linear and, before anything is written, for a scene in place of an input,
/// InputError for a name that does not end in .pov and for more objects than 24 bits count, MachineError for what
/// cannot be written.
DGTKSCENEEXPORT_EXPORT PovResult exportPov(
  const SceneState& state, const View& view, const std::string& path, const PovOptions& options = {});

/// Writes a model in its own axes and size, at its first frame, with a camera before it that shows it whole and that
/// tells readers that the axes are right-handed. Throws as above.
DGTKSCENEEXPORT_EXPORT PovResult exportPov(const std::shared_ptr<const Model>& model, const std::string& path);

/// Meshes and pictures that several scenes use: each is written once into a folder, under a name that holds a hash of
/// its contents. Thread-safe.
class DGTKSCENEEXPORT_EXPORT PovLibrary
{
public:
  /// `reference` is the folder as scenes name it, with its '/' at the end, or "": names of files that begin with it
  /// must be found by POV-Ray. The folder must exist when the first scene is made. `announce` is told each file's name,
  /// without folder, before it is written.
  PovLibrary(
    const std::string& folder, const std::string& reference,
    std::function<void(const std::string& name)> announce = [](const std::string&) {});
  ~PovLibrary();
  PovLibrary(const PovLibrary&) = delete;
  PovLibrary& operator=(const PovLibrary&) = delete;

  struct Impl;
  Impl& impl() { return *this->Self; }

private:
  std::unique_ptr<Impl> Self;
};

/// Rows first, first + 1, ..., first + count - 1 of the camera's image; count 0: all of it.
struct PovRows
{
  int first = 0;
  int count = 0;
};

/// A file of a library.
struct PovFile
{
  std::string name; ///< without folder
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// A scene that includes its meshes.
struct PovScene
{
  std::string text;
  std::vector<PovFile> uses; ///< files of the library in the order of their first use
  std::vector<std::string> warnings;
  double scale = 1; ///< as in PovResult
};

/// The small file of a camera at a frame; what it includes has been written into the library. With `rows`, its camera
/// shows these rows only, by the same rays. `name` is the file's, for the command in its second line. Throws as
/// exportPov().
DGTKSCENEEXPORT_EXPORT PovScene makePovScene(const SceneState& state, const View& view, const PovOptions& options,
  PovLibrary& library, const PovRows& rows = {}, const std::string& name = "FILE");

/// What POV-Ray will show otherwise than the built-in renderer, one line each: PovScene::warnings.
DGTKSCENEEXPORT_EXPORT std::vector<std::string> povNotes(
  const SceneState& state, const View& view, const PovOptions& options);

/// POV-Ray's options for N x N points a pixel on a grid, without noise.
DGTKSCENEEXPORT_EXPORT std::vector<std::string> povAntialias(int points);

/// The files of the library that a written scene names, without folder. Throws InputError for an unreadable file.
DGTKSCENEEXPORT_EXPORT std::vector<std::string> povSceneUses(const std::string& path);

} // namespace dgtk

#endif
