// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleMaker_h
#define dgtkSampleMaker_h

#include "dgtkSampleExpansion.h"
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
  void checkWanted() const;
  SceneDescription readTree(const JsonNode& tree) const;
  /// Replaces the points below a node whose objects have their places; true when all are.
  bool settle(JsonNode& node, const std::string& shown, const std::set<std::size_t>& waiting);
  void settleObjects(bool placed);
  std::set<std::size_t> waitingObjects(bool placed);
  void place();
  void leaveOut();
  void addCamera(std::size_t index, JsonNode& list);
  /// False: left out, `note` says why.
  bool makeCamera(std::size_t index, std::uint32_t attempt, JsonNode& camera, SampleNote& note);
  SampleWorld& world();

  const RandomScene& Scene;
  SampleDraws Draws;
  SampleModels& Models;
  const SampleWatch& Watch;
  SampleExpansion Expansion;
  JsonNode Tree;
  std::vector<Rule> Rules;            ///< of objects
  SceneDescription Objects;           ///< of the tree; as far as their places are known
  bool Known = false;                 ///< `Objects` is read
  std::vector<std::string> Gone;      ///< names of objects that are left out
  std::set<std::size_t> Out;          ///< the same, indices
  std::unique_ptr<SampleWorld> World; ///< when all objects are where they belong
  std::vector<int> KeyFrames;         ///< of all but the camera that is made
  std::vector<SampleNote> Notes;
};

} // namespace dgtk

#endif
