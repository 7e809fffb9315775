// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltfMeshes.h"

#include "dgtkGltfPlacement.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dgtk::import
{

namespace
{
using Json = GltfFile::Json;
using Integers = GltfFile::Integers;

std::uint8_t byteOf(double share)
{
  return static_cast<std::uint8_t>(share > 0 ? std::lround(255 * std::min(share, 1.0)) : 0);
}

class MeshRepair
{
public:
  MeshRepair(GltfFile& file, Scene& scene)
    : File(file)
    , Whole(scene)
    , IsDone(scene.meshes.size())
  {
  }

  /// `meshes`: of the scene, one a primitive.
  void run(const Json& node, const std::vector<std::uint32_t>& meshes)
  {
    const Json& primitives = this->File.item("meshes", node.at("mesh")).at("primitives");
    if (meshes.size() != primitives.size())
    {
      GltfFile::fail("meshes are not as expected");
    }
    for (std::size_t i = 0; i < primitives.size(); ++i)
    {
      if (!this->IsDone.at(meshes[i]))
      {
        this->IsDone[meshes[i]] = true;
        this->run(primitives.at(i), this->Whole.meshes[meshes[i]]);
      }
    }
  }

  void finish()
  {
    if (this->LeftOut > 0)
    {
      this->Whole.warnings.push_back(std::to_string(this->LeftOut) + (this->LeftOut == 1 ? " surface" : " surfaces") +
                                     " left out: a vertex that does not exist");
    }
    if (this->Empty > 0)
    {
      this->Whole.warnings.push_back(
        std::to_string(this->Empty) + (this->Empty == 1 ? " primitive" : " primitives") + " left out: nothing to draw");
    }
  }

private:
  void run(const Json& primitive, Mesh& mesh)
  {
    const bool lacksVertices = this->File.vertices(primitive) == 0;
    if (!mesh.faceSizes.empty() && mesh.faceSizes[0] == 1 && (lacksVertices || primitive.value("mode", 4) != 0))
    {
      ++this->Empty; // inOrder() has made it points
      mesh.faceSizes.clear();
      mesh.faceVertices.clear();
    }
    this->count(primitive, mesh.faceSizes.size());
    if (lacksVertices)
    {
      mesh.positions.clear(); // of another one
      return;
    }
    const Json& attributes = primitive.at("attributes");
    const Json none = Json::object();
    const Json& material =
      primitive.contains("material") ? this->File.item("materials", primitive.at("material")) : none;
    this->glow(material, std::size_t(mesh.material));
    this->positions(primitive, mesh);
    if (this->isStored(attributes, "NORMAL"))
    {
      mesh.normals = this->vectors(attributes.at("NORMAL"), mesh);
    }
    if (attributes.contains("COLOR_0"))
    {
      this->colors(attributes.at("COLOR_0"), material.value("alphaMode", "OPAQUE"), mesh);
      this->light(material, this->Whole.materials.at(std::size_t(mesh.material)));
    }
    const std::vector<Placement> all = placementsOf(material);
    for (const Placement& picture : all)
    {
      this->lookAt(picture.texture);
    }
    this->coordinates(attributes, all.empty() ? Placement() : all.front(), mesh);
    if (std::any_of(all.begin(), all.end(), [&all](const Placement& p) { return !(p == all.front()); }))
    {
      this->say("material \"" + material.value("name", "").substr(0, 200) +
                "\" has pictures in several places: all lie where the first does");
    }
  }

  /// Once.
  void say(const std::string& warning)
  {
    if (this->Said.insert(warning).second)
    {
      this->Whole.warnings.push_back(warning);
    }
  }

  /// The importer passes over some pictures without a word.
  void lookAt(const Json& index)
  {
    const Json none = Json::object();
    const Json& texture = index.is_null() ? none : this->File.item("textures", index);
    if (!texture.contains("source"))
    {
      const Json extensions = texture.value("extensions", none);
      for (const auto& extension : extensions.items())
      {
        this->say("pictures of the glTF extension \"" + extension.key().substr(0, 100) + "\" are not read");
      }
      return;
    }
    const std::string uri = this->File.item("images", texture.at("source")).value("uri", "");
    const std::string head = uri.rfind("data:", 0) == 0 ? uri.substr(0, uri.find(',')) : ";base64";
    if (head.find(";base64") == std::string::npos)
    {
      this->say("pictures in the file that are not base64 are not read");
    }
  }

  /// The importer leaves out triangles without a word.
  void count(const Json& primitive, std::size_t found)
  {
    const int mode = primitive.value("mode", 4);
    if (mode >= 4 && primitive.contains("indices"))
    {
      const Json& accessor = this->File.item("accessors", primitive.at("indices"));
      if (this->File.hasSparseGaps(accessor))
      {
        GltfFile::fail("they are indices"); // which are the importer's
      }
      const std::size_t corners = accessor.at("count");
      const std::size_t all = mode == 4 ? corners / 3 : corners - std::min<std::size_t>(corners, 2);
      this->LeftOut += all - std::min(all, found);
    }
  }

  /// Whether an attribute is there, and not as the importer takes it to be.
  bool isStored(const Json& attributes, const std::string& name) const
  {
    if (!attributes.contains(name))
    {
      return false;
    }
    const Json& accessor = this->File.item("accessors", attributes.at(name));
    return accessor.at("componentType") != GltfFile::floatType || accessor.contains("sparse");
  }

  std::vector<Float3> vectors(std::size_t accessor, const Mesh& mesh)
  {
    const std::vector<double> all = this->File.ofVertices(accessor, 3, Integers::AsSaid, mesh);
    std::vector<Float3> to;
    for (std::size_t i = 0; i + 2 < all.size(); i += 3)
    {
      to.push_back({ float(all[i]), float(all[i + 1]), float(all[i + 2]) });
    }
    return to;
  }

  /// And those of morph targets, which are differences.
  void positions(const Json& primitive, Mesh& mesh)
  {
    const Json& attributes = primitive.at("attributes");
    const bool stored = this->isStored(attributes, "POSITION");
    if (stored)
    {
      mesh.positions = this->vectors(attributes.at("POSITION"), mesh);
    }
    const Json targets = primitive.value("targets", Json::array());
    for (std::size_t t = 0; t < std::min(targets.size(), mesh.targets.size()); ++t)
    {
      const bool moves = targets[t].contains("POSITION");
      if (!stored && !this->isStored(targets[t], "POSITION"))
      {
        continue;
      }
      mesh.targets[t].positions = mesh.positions;
      const std::vector<Float3> by = moves ? this->vectors(targets[t].at("POSITION"), mesh) : std::vector<Float3>();
      for (std::size_t i = 0; i < 3 * by.size(); ++i)
      {
        mesh.targets[t].positions[i / 3][i % 3] += by[i / 3][i % 3];
      }
    }
  }

  /// Linear light; alpha counts where the material is to be seen through.
  void colors(std::size_t accessor, const std::string& alphaMode, Mesh& mesh)
  {
    bool cuts = false;
    const std::size_t channels = this->File.item("accessors", accessor).at("type") == "VEC4" ? 4 : 3;
    const std::vector<double> all = this->File.ofVertices(accessor, channels, Integers::Shares, mesh);
    mesh.colors.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.colors.size(); ++i)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        mesh.colors[i][c] = byteOf(portable::srgbFromLinear(all[channels * i + c]));
      }
      const std::uint8_t alpha = channels == 4 ? byteOf(all[channels * i + 3]) : 255;
      mesh.colors[i][3] = alphaMode == "BLEND" ? alpha : 255;
      cuts = cuts || (alphaMode == "MASK" && alpha < 255);
    }
    if (cuts)
    {
      this->say("the alpha of colours of vertices does not count where alphaMode is MASK");
    }
  }

  /// KHR_materials_emissive_strength: times the emission, in linear light. What is unlit has its colour.
  void glow(const Json& from, std::size_t material)
  {
    const Json none = Json::object();
    const Json extensions = from.value("extensions", none);
    const double strength = extensions.value("KHR_materials_emissive_strength", none).value("emissiveStrength", 1.0);
    if (strength != 1 && !extensions.contains("KHR_materials_unlit") && this->Glowing.insert(material).second)
    {
      for (double& part : this->Whole.materials.at(material).emission)
      {
        part = double(portable::encodedFromLinear(float(portable::linearFromSrgb(part) * std::max(strength, 0.0))));
      }
    }
  }

  /// What glows has no colours of vertices here: an unlit material is lit instead.
  void light(const Json& from, Material& to)
  {
    const Json extensions = from.value("extensions", Json::object());
    if (extensions.contains("KHR_materials_unlit") && to.diffuse == std::array<double, 3>{ 0, 0, 0 })
    {
      to.diffuse = to.emission;
      std::transform(to.diffuse.begin(), to.diffuse.end(), to.ambient.begin(), [](double d) { return 0.2 * d; });
      to.emission = { 0, 0, 0 };
      this->Whole.warnings.push_back(
        "material \"" + to.name.substr(0, 200) + "\" is lit: an unlit one would not show the colours of vertices");
    }
  }

  void coordinates(const Json& attributes, const Placement& where, Mesh& mesh)
  {
    const std::string name = "TEXCOORD_" + std::to_string(where.set);
    if (attributes.contains(name) && (where.set != where.importedSet || this->isStored(attributes, name)))
    {
      const std::vector<double> all = this->File.ofVertices(attributes.at(name), 2, Integers::AsSaid, mesh);
      mesh.uvs.resize(mesh.positions.size());
      for (std::size_t i = 0; i < mesh.uvs.size(); ++i)
      {
        mesh.uvs[i] = { float(all[2 * i]), float(1 - all[2 * i + 1]) };
      }
    }
    if (!where.isPlain())
    {
      place(where, mesh);
    }
  }

  GltfFile& File;
  Scene& Whole;
  std::vector<bool> IsDone;
  std::set<std::string> Said;
  std::set<std::size_t> Glowing;
  std::size_t LeftOut = 0; ///< triangles
  std::size_t Empty = 0;   ///< primitives
};
} // namespace

void repairMeshes(GltfFile& file, const NodeMatch& nodes, Scene& scene)
{
  MeshRepair repair(file, scene);
  const Json all = file.root().value("nodes", Json::array());
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    const std::int32_t index = nodes.of(n);
    if (index != noIndex && all[n].contains("mesh"))
    {
      repair.run(all[n], scene.nodes[static_cast<std::size_t>(index)].meshes);
    }
  }
  repair.finish();
}

} // namespace dgtk::import
