// SPDX-License-Identifier: BSD-3-Clause
// Writes small glTF 2.0 files: arrays become accessors of one buffer, the rest is JSON as the test says it.
#ifndef dgtkGltfMaker_h
#define dgtkGltfMaker_h

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk::test
{

class GltfMaker
{
public:
  nlohmann::json json = { { "asset", { { "version", "2.0" } } }, { "scene", 0 },
    { "accessors", nlohmann::json::array() }, { "bufferViews", nlohmann::json::array() } };

  /// Index of a new accessor; `type`: SCALAR, VEC2, VEC3, VEC4, MAT4.
  int floats(const std::string& type, const std::vector<float>& values)
  {
    return this->accessor(type, 5126, values, true);
  }
  int shorts(const std::string& type, const std::vector<std::uint16_t>& values)
  {
    return this->accessor(type, 5123, values, false);
  }
  int bytes(const std::string& type, const std::vector<std::uint8_t>& values)
  {
    return this->accessor(type, 5121, values, false);
  }
  /// Index of a buffer view holding a file.
  int view(const std::string& contents);

  std::string gltf() const;
  std::string glb() const;

private:
  static int width(const std::string& type) { return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type[3] - '0'; }
  template <class T>
  int accessor(const std::string& type, int component, const std::vector<T>& values, bool limits)
  {
    const auto n = static_cast<std::size_t>(width(type));
    const int at = this->view(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
    nlohmann::json made = { { "bufferView", at }, { "componentType", component }, { "type", type },
      { "count", values.size() / n } };
    for (std::size_t i = 0; limits && i < n; ++i)
    {
      T low = values[i];
      T high = values[i];
      for (std::size_t k = i; k < values.size(); k += n)
      {
        low = std::min(low, values[k]);
        high = std::max(high, values[k]);
      }
      made["min"].push_back(low);
      made["max"].push_back(high);
    }
    this->json["accessors"].push_back(made);
    return static_cast<int>(this->json["accessors"].size()) - 1;
  }
  std::string Buffer;
};

/// One triangle with a material, mirrored by its node.
GltfMaker plain(const nlohmann::json& material);

} // namespace dgtk::test

#endif
