// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleExpansion_h
#define dgtkSampleExpansion_h

#include "dgtkDistributions.h"
#include "dgtkJson.h"
#include "dgtkRandomScene.h"
#include "dgtkSampleDraws.h"
#include "dgtkSampleRule.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// The tree of a random scene with its values drawn: numbers, names and GeometryPoints are left. Errors are InputErrors
/// that name the value's path and line in the random scene.
class SampleExpansion
{
public:
  /// What objects and cameras ask for beyond values.
  struct Rule
  {
    std::size_t index = 0; ///< of the object in the tree
    std::string path;
    JsonDocument rule;
  };

  /// What is drawn goes to `values`, if there are.
  SampleExpansion(const RandomScene& scene, const SampleDraws& draws, std::vector<SampleValue>* values = nullptr);

  /// Everything but the cameras; the rules of the objects go to `rules`.
  JsonNode world(std::vector<Rule>& rules);
  /// Whether a name or pattern fits instances of an object that a sample may have without, its count being random.
  bool mayLack(const std::string& pattern) const;
  /// Whether it fits an object whose count is 0 in this sample.
  bool isOfNone(const std::string& pattern) const;
  std::size_t cameras() const { return this->CameraList == nullptr ? 0 : this->CameraList->children.size(); }
  /// A camera of an attempt; its rules by their keys.
  JsonNode camera(std::size_t index, std::uint32_t attempt, std::map<std::string, Rule>& rules);
  /// The path of a camera: "cameras/left".
  std::string pathOfCamera(std::size_t index) const;

private:
  /// Where a value stands.
  struct At
  {
    std::string path;         ///< of its draws
    std::string shared;       ///< of draws that the instances of a counted object share
    std::string shown;        ///< as errors say it
    std::size_t instance = 0; ///< of a counted object, from 1
    bool named = true;        ///< false: in an item without a name
    At below(const std::string& key, const std::string& shownKey) const;
  };
  enum class Drawn
  {
    Never,
    Now,
    Done
  };

  [[noreturn]] void fail(const JsonNode& node, const At& at, const std::string& what, const std::string& expected = {},
    const std::string& found = {}) const;
  JsonDocument documentOf(JsonNode node, const At& at) const;
  JsonNode value(const JsonNode& node, const std::string& key, const At& at);
  JsonNode parameter(const JsonNode& node, const At& at);
  JsonNode random(const std::string& word, const JsonNode& node, const At& at);
  JsonNode choice(const JsonNode& node, const At& at);
  JsonNode permutation(const JsonNode& node, const At& at);
  JsonNode arguments(const JsonNode& node, const At& at);
  ValueUniforms uniforms(const JsonNode& node, const At& at, bool mayStratify = true);
  void tell(const std::string& path, const JsonNode& drawn);
  /// Takes back what was told of a camera: nothing else was since.
  void forget(const std::string& camera);
  JsonNode members(const JsonNode& node, const At& at, const std::vector<std::string>& without);
  void addItems(const JsonNode& list, const std::string& key, std::vector<Rule>& rules, JsonNode& root);
  void addObjects(const JsonNode& item, const At& at, std::vector<Rule>& rules, JsonNode& list);
  void refusePose(const JsonNode& item, const At& at, const JsonNode& place) const;
  std::string nameOf(const JsonNode& item, const At& at) const;
  std::size_t countOf(const std::string& name);
  static std::string parentOf(const JsonNode& item);
  void addOrder(const JsonNode& order, JsonNode& root);

  const RandomScene& Scene;
  const SampleDraws& Draws;
  std::vector<SampleValue>* Values;
  std::map<std::string, std::size_t> Told; ///< path -> index in `Values`
  std::uint32_t Attempt = 0;
  const JsonNode* CameraList = nullptr;
  std::map<std::string, std::pair<Drawn, JsonNode>> Parameters;
  std::map<std::string, const JsonNode*> Objects;              ///< by name
  std::map<std::string, std::string> Shown;                    ///< paths of objects, by name
  std::map<std::string, std::pair<Drawn, std::size_t>> Counts; ///< of counted objects; 0: not counted
  std::set<std::string> Varying;                               ///< those whose count is drawn
  std::vector<std::size_t> Instances;                          ///< of each object of the file
};

} // namespace dgtk

#endif
