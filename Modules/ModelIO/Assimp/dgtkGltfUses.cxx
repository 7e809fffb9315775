// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltfUses.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace dgtk::import
{

namespace
{
using Json = GltfFile::Json;
using Integers = GltfFile::Integers;

class UseRepair
{
public:
  UseRepair(GltfFile& file, const NodeMatch& nodes, Scene& scene)
    : File(file)
    , Nodes(nodes)
    , Whole(scene)
  {
  }

  /// Meshes are as the file has them until all nodes have theirs.
  void run()
  {
    const Json all = this->File.root().value("nodes", Json::array());
    for (std::size_t n = 0; n < all.size(); ++n)
    {
      const std::int32_t index = this->Nodes.of(n);
      if (index != noIndex && all[n].contains("mesh"))
      {
        this->add(all[n], this->Whole.nodes[static_cast<std::size_t>(index)].meshes);
      }
    }
    for (const auto& [use, to] : this->Uses)
    {
      const auto& [mesh, skin, weights] = use;
      this->say(*this->Primitives.at(mesh), skin, weights, this->Whole.meshes[to]);
    }
  }

private:
  using Use = std::tuple<std::uint32_t, Json, Json>; ///< mesh of the scene, the node's skin and weights, or null

  void add(const Json& node, std::vector<std::uint32_t>& meshes)
  {
    const Json& primitives = this->File.item("meshes", node.at("mesh")).at("primitives");
    if (meshes.size() != primitives.size())
    {
      GltfFile::fail("meshes are not as expected");
    }
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      const std::uint32_t mesh = meshes[i];
      const auto [known, isNew] =
        this->Uses.emplace(Use{ mesh, node.value("skin", Json()), node.value("weights", Json()) }, mesh);
      if (!this->Primitives.emplace(mesh, &primitives[i]).second && isNew)
      {
        known->second = static_cast<std::uint32_t>(this->Whole.meshes.size());
        this->Whole.meshes.push_back(Mesh(this->Whole.meshes.at(mesh)));
      }
      meshes[i] = known->second;
    }
  }

  void say(const Json& primitive, const Json& skin, const Json& weights, Mesh& mesh)
  {
    if (mesh.positions.empty())
    {
      return; // left out
    }
    const Json& attributes = primitive.at("attributes");
    for (std::size_t t = 0; t < std::min(weights.size(), mesh.targets.size()); ++t)
    {
      mesh.targets[t].weight = double(weights[t].get<float>()); // as the importer reads those of meshes
    }
    if (!skin.is_null())
    {
      this->bones(this->File.item("skins", skin), mesh);
      this->influences(attributes, mesh);
    }
    if (attributes.contains("NORMAL"))
    {
      this->normals(primitive.value("targets", Json::array()), mesh);
    }
  }

  void bones(const Json& skin, Mesh& mesh)
  {
    const Json& joints = skin.at("joints");
    std::vector<double> matrices; // by columns; the identity unless said otherwise
    if (skin.contains("inverseBindMatrices"))
    {
      matrices = this->File.numbers(skin.at("inverseBindMatrices"), 16, Integers::AsSaid);
      if (matrices.size() < 16 * joints.size())
      {
        GltfFile::fail("a joint has no matrix");
      }
    }
    mesh.bones.assign(joints.size(), {});
    for (std::size_t j = 0; j < joints.size(); ++j)
    {
      mesh.bones[j].node = this->Nodes.of(joints[j]);
      for (std::size_t i = 0; i < 16; ++i)
      {
        mesh.bones[j].bone_from_mesh[i] =
          matrices.empty() ? (i % 5 == 0 ? 1 : 0) : matrices[16 * j + i % 4 * 4 + i / 4];
      }
    }
  }

  void influences(const Json& attributes, Mesh& mesh)
  {
    bool isFloat = true;
    for (int set = 0;; ++set)
    {
      const std::string weightsName = "WEIGHTS_" + std::to_string(set);
      const std::string jointsName = "JOINTS_" + std::to_string(set);
      if (!attributes.contains(weightsName) || !attributes.contains(jointsName))
      {
        break;
      }
      const std::size_t accessor = attributes.at(weightsName);
      isFloat = isFloat && this->File.item("accessors", accessor).at("componentType") == GltfFile::floatType;
      const std::vector<double> weights = this->File.ofVertices(accessor, 4, Integers::Shares, mesh);
      const std::vector<double> joints = this->File.ofVertices(attributes.at(jointsName), 4, Integers::AsSaid, mesh);
      for (std::size_t i = 0; i < weights.size(); ++i)
      {
        if (weights[i] > 0)
        {
          if (!(joints[i] >= 0 && joints[i] < double(mesh.bones.size())))
          {
            GltfFile::fail("a vertex follows a joint that does not exist");
          }
          Bone& bone = mesh.bones[static_cast<std::size_t>(joints[i])];
          bone.vertices.push_back(static_cast<std::uint32_t>(i / 4));
          bone.weights.push_back(static_cast<float>(weights[i]));
        }
      }
    }
    for (Bone& bone : mesh.bones)
    {
      if (isFloat && bone.vertices.empty()) // as Assimp has it: which vertices are one hangs on it
      {
        bone.vertices = { 0 };
        bone.weights = { 0 };
      }
    }
  }

  /// Targets have differences.
  void normals(const Json& targets, Mesh& mesh)
  {
    for (std::size_t t = 0; t < std::min(targets.size(), mesh.targets.size()); ++t)
    {
      const double weight = mesh.targets[t].weight;
      if (weight != 0 && targets[t].contains("NORMAL"))
      {
        const std::vector<double> by = this->File.ofVertices(targets[t].at("NORMAL"), 3, Integers::AsSaid, mesh);
        mesh.restNormals = mesh.restNormals.empty() ? mesh.normals : mesh.restNormals;
        if (3 * mesh.restNormals.size() != by.size())
        {
          GltfFile::fail("normals are not as expected");
        }
        for (std::size_t i = 0; i < by.size(); ++i)
        {
          mesh.restNormals[i / 3][i % 3] += static_cast<float>(weight * by[i]);
        }
      }
    }
  }

  GltfFile& File;
  const NodeMatch& Nodes;
  Scene& Whole;
  std::map<Use, std::uint32_t> Uses; ///< -> mesh of the scene
  std::map<std::uint32_t, const Json*> Primitives;
};
} // namespace

void repairUses(GltfFile& file, const NodeMatch& nodes, Scene& scene) { UseRepair(file, nodes, scene).run(); }

} // namespace dgtk::import
