// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleMaker_h
#define dgtkSampleMaker_h

#include "dgtkSampleExpansion.h"
#include "dgtkSampleGeometry.h"
#include "dgtkSampleWorld.h"
#include "dgtkSampler.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// The steps of one sample: values, what geometry decides, placement, cameras.
class SampleMaker
{
public:
  SampleMaker(
    const RandomScene& scene, std::uint64_t seed, std::uint64_t sample, SampleModels& models, const SampleWatch& watch);
  SceneSample make();

private:
  using Rule = SampleExpansion::Rule;

  [[noreturn]] void fail(const JsonNode& node, const std::string& path, const std::string& what,
    const std::string& expected, const std::string& found) const;
  /// Of a name or pattern that no object has.
  [[noreturn]] void failName(const JsonNode& node, const std::string& path, const std::string& name) const;
  void checkWanted() const;
  /// The path of a rule or value that errors call "cameras[0].lookAt.keys": "cameras/left/lookAt".
  std::string pathOf(const std::string& shown) const;
  /// Why a sample of the scene has no object of a name or pattern; "": the scene has none.
  std::string whyAbsent(const std::string& pattern) const;
  /// Why there is nothing that a rule `place` puts its object on or in; "": there is, or the rule is wrong.
  std::string whyUnsupported(const JsonNode& rule) const;
  SceneDescription readTree(const JsonNode& tree) const;
  /// Replaces the points below a node whose objects have their places; true when all are.
  bool settle(JsonNode& node, const std::string& shown, const std::set<std::size_t>& waiting);
  void readObjects();
  void settleObjects(bool placed);
  std::set<std::size_t> waitingObjects(bool placed);
  void place();
  void leaveOut();
  /// Draws cameras that are mounted on each other, the first on none, until what all of them ask for is true.
  void addRig(const std::vector<std::size_t>& rig);
  void leaveOutRig(const std::vector<std::size_t>& rig, std::size_t because, const SampleNote& note);
  CameraDescription cameraAlone(const JsonNode& camera) const;
  /// False: left out, `note` says why.
  bool makeCamera(std::size_t index, std::uint32_t attempt, JsonNode& camera, SampleNote& note);
  void travel(std::size_t index, std::uint32_t attempt, const SampleRule& path, JsonNode& camera, SampleNote& note);
  void mount(std::size_t index, const JsonDocument& rig, JsonNode& camera) const;
  void refusePose(const JsonNode& camera, const std::vector<const char*>& keys, const std::string& shown,
    const std::string& beside) const;
  SampleWorld& world();

  const RandomScene& Scene;
  SampleDraws Draws;
  SampleModels& Models;
  const SampleWatch& Watch;
  SampleExpansion Expansion;
  JsonNode Tree;
  std::vector<Rule> Rules;                       ///< of objects
  SceneDescription Objects;                      ///< of the tree; as far as their places are known
  std::optional<SampleGeometry> Geometry;        ///< of `Objects`, when these are read
  std::vector<std::string> Gone;                 ///< names of objects that are left out
  std::set<std::size_t> Out;                     ///< the same, indices
  std::unique_ptr<SampleWorld> World;            ///< when all objects are where they belong
  std::vector<int> KeyFrames;                    ///< of all but the camera that is made
  std::map<std::size_t, JsonNode> Cameras;       ///< that are made, by their index in the file
  std::map<std::size_t, SampleNote> CameraNotes; ///< of those that have any
  std::vector<SampleNote> Notes;
};

} // namespace dgtk

#endif
