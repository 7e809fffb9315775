// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGltf_h
#define dgtkGltf_h

// Private to Export: parts of a glTF 2.0 asset.

#include "dgtkDatasetView.h"
#include "dgtkExporter.h"
#include "dgtkModelPly.h"

#include <nlohmann/json.hpp>

#include <array>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

namespace dgtk::gltf
{

using Json = nlohmann::ordered_json;

/// The buffer of an asset, written piece by piece, and what its document says of it.
class Buffer
{
public:
  explicit Buffer(ExportFile& file)
    : File(file)
  {
  }
  enum class Use
  {
    Animation,
    Vertices,
    Indices
  };
  /// Numbers of an accessor: "SCALAR", "VEC2", "VEC3", "VEC4". Returns its index. Limits are smallest and largest
  /// values of each component.
  std::size_t add(const std::vector<float>& numbers, const std::string& type, Use use, bool limits = false);
  std::size_t add(const std::vector<std::uint32_t>& indices);
  /// Adds buffers, bufferViews and accessors.
  void describe(Json& asset, const std::string& name) const;

private:
  std::size_t put(const void* data, std::size_t bytes, Json accessor, Use use);
  ExportFile& File;
  std::uint64_t Bytes = 0;
  Json Views = Json::array();
  Json Accessors = Json::array();
};

/// Where something is: x_parent = R diag(scale) x + t; metres from its own unit.
struct Place
{
  Eigen::Vector3d t{ 0, 0, 0 };
  Eigen::Vector4d q{ 1, 0, 0, 0 }; ///< w x y z
  Eigen::Vector3d scale{ 1, 1, 1 };
};
/// What float32 makes of keys.
struct KeyRounding
{
  LayerRounding places{ "poses", "m", 0, 0, 0 };
  LayerRounding turns{ "poses", "1", 0, 0, 0 }; ///< and scales
};
/// A node of the first place, and channels of an animation where places differ; `times` in seconds.
Json placedNode(const Place& first);
void animate(Json& animation, Buffer& buffer, std::size_t node, const std::vector<double>& times,
  const std::vector<Place>& places, KeyRounding& rounding);

/// How a part of a model looks.
struct Look
{
  std::string picture;                                ///< "" for none
  std::string wrap;                                   ///< as ModelPly has it
  std::array<std::uint8_t, 3> color{ 255, 255, 255 }; ///< sRGB
  bool operator<(const Look& other) const
  {
    return std::tie(this->picture, this->wrap, this->color) < std::tie(other.picture, other.wrap, other.color);
  }
};
/// The sampler of a texture that is wrapped so.
Json samplerOf(const std::string& wrap);
/// Linear light of sRGB of 8 bits.
double linear(std::uint8_t level);
/// A mesh of one primitive for each look. A model of more looks than a few has its colours at its vertices. `materials`
/// gives the index of a look's material.
Json meshOf(
  Buffer& buffer, const ModelPly& model, bool mirrored, const std::function<std::size_t(const Look&)>& materials);

/// Lights of a scene.json as KHR_lights_punctual has them, each with its place. `approximate` gets the names of those
/// that are not quite what the scene has, and of those left out.
struct Light
{
  Json light;
  Place place;
};
std::vector<Light> lightsOf(
  const nlohmann::json& scene, double metres, std::vector<std::string>& approximate, std::vector<std::string>& without);

} // namespace dgtk::gltf

#endif
