// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltfMaker.h"

namespace dgtk::test
{

namespace
{
/// RFC 4648
std::string base64(const std::string& bytes)
{
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

std::string word(std::size_t value)
{
  std::string text;
  for (int i = 0; i < 4; ++i)
  {
    text += static_cast<char>(value >> (8 * i) & 255);
  }
  return text;
}

std::string padded(std::string text, char by)
{
  text.append((4 - text.size() % 4) % 4, by);
  return text;
}
} // namespace

int GltfMaker::view(const std::string& contents)
{
  this->Buffer = padded(this->Buffer, '\0');
  this->json["bufferViews"].push_back(
    { { "buffer", 0 }, { "byteOffset", this->Buffer.size() }, { "byteLength", contents.size() } });
  this->Buffer += contents;
  return static_cast<int>(this->json["bufferViews"].size()) - 1;
}

std::string GltfMaker::gltf() const
{
  nlohmann::json whole = this->json;
  whole["buffers"] = { { { "byteLength", this->Buffer.size() },
    { "uri", "data:application/octet-stream;base64," + base64(this->Buffer) } } };
  return whole.dump();
}

std::string GltfMaker::glb() const
{
  nlohmann::json whole = this->json;
  whole["buffers"] = { { { "byteLength", this->Buffer.size() } } };
  const std::string text = padded(whole.dump(), ' ');
  const std::string buffer = padded(this->Buffer, '\0');
  return "glTF" + word(2) + word(28 + text.size() + buffer.size()) + word(text.size()) + "JSON" + text +
         word(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

GltfMaker plain(const nlohmann::json& material)
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 1, 0 });
  const int uvs = maker.floats("VEC2", { 0, 0, 1, 0, 0, 1 });
  maker.json["scenes"] = { { { "nodes", { 0 } } } };
  maker.json["nodes"] = { { { "name", "Parent" }, { "scale", { 2, 2, -2 } }, { "children", { 1 } } },
    { { "name", "Child" }, { "mesh", 0 }, { "translation", { 0, 0, 3 } } } };
  maker.json["meshes"] = { { { "name", "Triangle" },
    { "primitives",
      { { { "attributes", { { "POSITION", positions }, { "TEXCOORD_0", uvs } } }, { "material", 0 } } } } } };
  maker.json["materials"] = { material };
  return maker;
}

} // namespace dgtk::test
