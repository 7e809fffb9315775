// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltfPlacement.h"

#include "dgtkPortableMath.h"

namespace dgtk::import
{

namespace
{
using Json = GltfFile::Json;

Placement placementOf(const Json& info)
{
  Placement to;
  to.set = to.importedSet = info.value("texCoord", std::size_t(0));
  to.texture = info.value("index", Json());
  const Json none = Json::object();
  const Json& extensions = info.contains("extensions") ? info.at("extensions") : none;
  if (extensions.contains(textureTransform))
  {
    const Json& from = extensions.at(textureTransform);
    to.set = from.value("texCoord", to.set);
    to.offset = from.value("offset", to.offset);
    to.rotation = from.value("rotation", to.rotation);
    to.scale = from.value("scale", to.scale);
  }
  return to;
}

} // namespace

std::vector<Placement> placementsOf(const Json& material)
{
  std::vector<Placement> all;
  const auto add = [&all](const Json& of, const char* name, bool isColor)
  {
    if (of.contains(name))
    {
      all.push_back(placementOf(of.at(name)));
      all.back().importedSet = isColor ? all.back().importedSet : 0;
    }
  };
  const Json none = Json::object();
  const Json surface = material.value("pbrMetallicRoughness", none);
  add(surface, "baseColorTexture", true);
  add(material.value("extensions", none).value("KHR_materials_pbrSpecularGlossiness", none), "diffuseTexture", true);
  add(surface, "metallicRoughnessTexture", false);
  for (const char* const name : { "normalTexture", "occlusionTexture", "emissiveTexture" })
  {
    add(material, name, false);
  }
  return all;
}

void place(const Placement& where, Mesh& mesh)
{
  const double c = portable::cos(where.rotation);
  const double s = portable::sin(where.rotation);
  for (std::array<float, 2>& uv : mesh.uvs)
  {
    const double x = where.scale[0] * double(uv[0]);
    const double y = where.scale[1] * (1 - double(uv[1]));
    uv = { float(c * x + s * y + where.offset[0]), float(1 - (c * y - s * x + where.offset[1])) };
  }
}

} // namespace dgtk::import
