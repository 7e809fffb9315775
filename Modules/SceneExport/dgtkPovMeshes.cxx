// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovMeshes.h"

#include "dgtkPovMaterials.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dgtk
{

namespace
{
/// Largest sine of the angle between a vertex's normal and its triangle's that counts as none.
constexpr double flatAngle = 1e-5;

/// Whether all shading normals are their triangles' own.
bool isFlat(const Model& model, const Geometry& geometry)
{
  return std::all_of(model.triangles.begin(), model.triangles.end(),
    [&](const std::array<std::uint32_t, 3>& triangle)
    {
      const Eigen::Vector3d& a = geometry.positions[triangle[0]];
      const Eigen::Vector3d normal =
        (geometry.positions[triangle[1]] - a).cross(geometry.positions[triangle[2]] - a).normalized();
      return std::all_of(triangle.begin(), triangle.end(),
        [&](std::uint32_t vertex)
        {
          const Eigen::Vector3d own = geometry.normals[vertex].cast<double>();
          return normal.dot(own) > 0 && normal.cross(own).norm() < flatAngle;
        });
    });
}

template <class List, class Write>
void writeList(PovText& text, const char* name, const List& list, Write write)
{
  text << std::string("  ") + name + " { " + std::to_string(list.size());
  for (const auto& item : list)
  {
    text << ",\n    " + write(item);
  }
  text << "\n  }\n";
}

void writeVertices(PovText& text, const Instance& instance)
{
  const Model& model = *instance.model;
  const Geometry& geometry = *instance.geometry;
  const auto vector = [](const auto& v) { return povVector(v); };
  writeList(text, "vertex_vectors", geometry.positions, vector);
  if (!isFlat(model, geometry))
  {
    writeList(text, "normal_vectors", geometry.normals, vector);
  }
  if (!model.uvs.empty())
  {
    writeList(text, "uv_vectors", model.uvs, vector);
  }
}

/// ", 3", the texture of a triangle, or "".
std::string faceTexture(const PovTextures& textures, std::uint32_t triangle, int material)
{
  if (textures.ofMaterial.empty())
  {
    return {};
  }
  const auto own = textures.ofTriangle.find(triangle);
  return ", " + std::to_string(own == textures.ofTriangle.end()
                                 ? textures.ofMaterial[static_cast<std::size_t>(material)]
                                 : own->second);
}

void writeFaces(PovText& text, const Model& model, const PovTextures& textures)
{
  text << "  face_indices { " + std::to_string(model.triangles.size());
  for (const Part& part : model.parts)
  {
    for (std::uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangles; ++i)
    {
      const auto& triangle = model.triangles[i];
      text << ",\n    <" + std::to_string(triangle[0]) + ", " + std::to_string(triangle[1]) + ", " +
                std::to_string(triangle[2]) + '>' + faceTexture(textures, i, part.material);
    }
  }
  text << "\n  }\n";
}
} // namespace

const std::vector<Material>& povMaterialsOf(const Instance& instance)
{
  return instance.materials ? *instance.materials : instance.model->materials;
}

std::uint32_t povOwnId(const Instance& instance, std::uint32_t id, const PovSurfaceOptions& options)
{
  const std::vector<Material>& materials = povMaterialsOf(instance);
  const bool cutOut = std::any_of(
    materials.begin(), materials.end(), [&](const Material& material) { return povCutOut(*instance.model, material); });
  return options.flatIds && cutOut ? id : 0;
}

PovTextures povTexturesOf(
  const Instance& instance, std::uint32_t ownId, const PovSurfaceOptions& options, PovImages& images)
{
  PovTextures textures;
  if ((options.flatIds || options.positionColors) && ownId == 0)
  {
    return textures;
  }
  const Model& model = *instance.model;
  const std::vector<Material>& materials = povMaterialsOf(instance);
  textures.ofMaterial.assign(materials.size(), -1);
  for (const Part& part : model.parts)
  {
    int& index = textures.ofMaterial[static_cast<std::size_t>(part.material)];
    if (index < 0 && part.triangles > 0)
    {
      const Material& material = materials[static_cast<std::size_t>(part.material)];
      index = static_cast<int>(textures.list.size());
      textures.list.push_back(options.flatIds
                                ? povFlatMaterial(model, material, ownId, images)
                                : povMaterial(povSurfaceOf(instance, std::size_t(part.material)), options, images));
    }
  }
  return textures;
}

void povWriteMesh(PovText& text, const Instance& instance, const PovTextures& textures)
{
  text << "{\n";
  writeVertices(text, instance);
  if (!textures.ofMaterial.empty())
  {
    writeList(text, "texture_list", textures.list, [](const std::string& texture) { return texture; });
  }
  writeFaces(text, *instance.model, textures);
  text << "}\n";
}

std::string PovMeshesInside::declare(const Instance& instance, std::uint32_t id, const PovTurned& turned)
{
  const std::uint32_t own = povOwnId(instance, id, this->Options);
  const auto write = [&](const std::string& name)
  {
    povDeclareMesh(this->Text, name, instance, povTexturesOf(instance, own, this->Options, this->Images), turned);
    this->Text << "\n";
    return name;
  };
  if (!turned.empty())
  {
    return write(this->nextName());
  }
  std::string& name =
    this->Names[{ instance.model.get(), instance.geometry.get(), &povMaterialsOf(instance), own, povUnitOf(instance) }];
  if (name.empty())
  {
    name = write(this->nextName());
  }
  return name;
}

} // namespace dgtk
