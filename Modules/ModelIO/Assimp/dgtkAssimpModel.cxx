// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpModel.h"

#include "dgtkAssimpCheck.h"
#include "dgtkAssimpDeformation.h"
#include "dgtkAssimpProcess.h"
#include "dgtkAssimpTexture.h"
#include "dgtkEqualItems.h"
#include "dgtkError.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dgtk
{

namespace
{
constexpr std::uint64_t mostCorners = 8'000'000;
constexpr double mostFrames = 1e9;

using Influences = std::vector<std::vector<std::pair<std::uint32_t, float>>>;

/// Bones and weights of each vertex; empty when there are none.
Influences influencesOf(const import::Mesh& mesh)
{
  Influences all(mesh.bones.empty() ? 0 : mesh.positions.size());
  for (std::size_t b = 0; b < mesh.bones.size(); ++b)
  {
    for (std::size_t i = 0; i < mesh.bones[b].vertices.size(); ++i)
    {
      all[mesh.bones[b].vertices[i]].emplace_back(static_cast<std::uint32_t>(b), mesh.bones[b].weights[i]);
    }
  }
  return all;
}

/// The first vertex of a mesh that is at the same place as each one and moves alike.
std::vector<std::uint32_t> weld(const import::Mesh& mesh)
{
  const Influences influences = influencesOf(mesh);
  const auto equal = [&](std::uint32_t a, std::uint32_t b)
  {
    const auto alike = [a, b](const import::Target& target) { return target.positions[a] == target.positions[b]; };
    return mesh.positions[a] == mesh.positions[b] && std::all_of(mesh.targets.begin(), mesh.targets.end(), alike) &&
           (influences.empty() || influences[a] == influences[b]) &&
           (mesh.dualQuaternions.empty() || mesh.dualQuaternions[a] == mesh.dualQuaternions[b]);
  };
  EqualItems known(mesh.positions.size());
  std::vector<std::uint32_t> first(mesh.positions.size());
  for (std::uint32_t i = 0; i < first.size(); ++i)
  {
    const import::Float3& p = mesh.positions[i];
    first[i] = known.find(i, mixed(mixed(mixed(0, p[0]), p[1]), p[2]), equal);
  }
  return first;
}

class Assembly
{
public:
  Assembly(const std::string& path, const std::string& format, const ReadOptions& options)
    : Path(path)
    , Format(format)
    , Scene(std::make_shared<ImportedScene>(importModel(path, format)))
    , Builder(path, format, this->Scene->bytesRead, options)
    , Materials(*this->Scene, this->Builder)
  {
  }

  ModelContents run()
  {
    try
    {
      checkScene(*this->Scene);
    }
    catch (const std::runtime_error& error)
    {
      throw InputError(this->Path, std::string("is damaged: ") + error.what());
    }
    this->Builder.model().companions = this->Scene->files;
    this->Builder.model().isNumbered = this->Format == "gltf";
    this->Builder.keep(this->Scene->dependencies, 0);
    for (const std::string& warning : this->Scene->warnings)
    {
      this->Builder.warn(warning);
    }
    this->collect();
    if (std::any_of(this->Posed.begin(), this->Posed.end(),
          [this](const PosedMesh& posed) { return !this->Scene->meshes[posed.mesh].colors.empty(); }))
    {
      this->Builder.setHasColors();
    }
    const AssimpDeformation whole(this->Scene, this->Posed);
    const bool moves = whole.moves();
    if (this->Format != "gltf" || moves)
    {
      this->weldVertices();
    }
    this->nameTextures();
    auto deformation = std::make_shared<AssimpDeformation>(this->Scene, this->Posed);
    const std::vector<Eigen::Affine3d> pose = deformation->pose(moves ? 0 : -1, 0);
    for (std::size_t i = 0; i < this->Posed.size(); ++i)
    {
      this->add(*deformation, i, pose, moves ? 0 : -1);
    }
    this->declare();
    if (moves)
    {
      this->addAnimations();
      this->Builder.setDeformation(deformation);
    }
    ModelContents contents = this->Builder.finish();
    setSourceOf(*contents.model, std::move(this->SourceOf));
    return contents;
  }

private:
  void collect()
  {
    std::uint64_t corners = 0;
    for (std::size_t n = 0; n < this->Scene->nodes.size(); ++n)
    {
      for (const std::uint32_t m : this->Scene->nodes[n].meshes)
      {
        corners += this->Scene->meshes[m].faceVertices.size() + this->Scene->meshes[m].positions.size() + 1;
        const std::uint64_t most = mostCorners + 2 * this->Scene->bytesRead;
        if (corners > most)
        {
          throw InputError(this->Path, "repeats its meshes too often", "at most " + std::to_string(most) + " corners");
        }
        PosedMesh posed{ static_cast<std::uint32_t>(n), m, {} };
        posed.vertices.resize(this->Scene->meshes[m].positions.size());
        std::iota(posed.vertices.begin(), posed.vertices.end(), 0u);
        this->Posed.push_back(std::move(posed));
      }
    }
  }

  void weldVertices()
  {
    this->First.resize(this->Scene->meshes.size());
    for (PosedMesh& posed : this->Posed)
    {
      std::vector<std::uint32_t>& first = this->First[posed.mesh];
      if (first.empty())
      {
        first = weld(this->Scene->meshes[posed.mesh]);
      }
      posed.vertices.clear();
      for (std::uint32_t i = 0; i < first.size(); ++i)
      {
        if (first[i] == i)
        {
          posed.vertices.push_back(i);
        }
      }
    }
  }

  /// Vertex of the mesh -> vertex of the model.
  std::vector<std::uint32_t> addVertices(const AssimpDeformation& deformation, const PosedMesh& posed,
    const std::vector<Eigen::Affine3d>& pose, int animation)
  {
    std::vector<Eigen::Vector3d> positions;
    deformation.positionsOf(posed, pose, animation, 0, positions);
    std::vector<std::uint32_t> model(this->Scene->meshes[posed.mesh].positions.size(), 0);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      model[posed.vertices[i]] = this->Builder.addVertex(positions[i]);
    }
    if (!this->First.empty())
    {
      const std::vector<std::uint32_t>& first = this->First[posed.mesh];
      for (std::size_t i = 0; i < first.size(); ++i)
      {
        model[i] = model[first[i]];
      }
    }
    if (!this->First.empty() && this->Builder.model().isNumbered)
    {
      this->SourceOf.insert(this->SourceOf.end(), model.begin(), model.end());
    }
    return model;
  }

  Corner corner(const import::Mesh& mesh, const std::vector<std::uint32_t>& model,
    const std::vector<std::int32_t>& normals, std::uint32_t vertex) const
  {
    Corner corner;
    corner.vertex = model[vertex];
    corner.normal = normals.empty() ? -1 : normals[vertex];
    if (!mesh.uvs.empty())
    {
      corner.u = mesh.uvs[vertex][0];
      corner.v = mesh.uvs[vertex][1];
    }
    corner.color = mesh.colors.empty() ? corner.color : mesh.colors[vertex];
    return corner;
  }

  void add(
    const AssimpDeformation& deformation, std::size_t index, const std::vector<Eigen::Affine3d>& pose, int animation)
  {
    const PosedMesh& posed = this->Posed[index];
    const import::Mesh& mesh = this->Scene->meshes[posed.mesh];
    const import::Node& node = this->Scene->nodes[posed.node];
    this->Builder.beginObject(node.name.empty() || node.name[0] == '<' ? mesh.name : node.name);
    const std::vector<std::uint32_t> model = this->addVertices(deformation, posed, pose, animation);
    const std::vector<Eigen::Matrix3d> linear = deformation.linearOf(posed.mesh, posed.node, pose);
    const bool mirrored = mesh.bones.empty() && pose[posed.node].linear().determinant() < 0;
    std::vector<std::int32_t> normals;
    const std::vector<import::Float3>& own =
      animation >= 0 || mesh.restNormals.empty() ? mesh.normals : mesh.restNormals;
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      const Eigen::Matrix3d& m = linear[linear.size() == 1 ? 0 : i];
      const Eigen::Vector3d n = (mirrored ? -1 : 1) * Eigen::Vector3d(own[i][0], own[i][1], own[i][2]);
      normals.push_back(this->Builder.addNormal(turnedNormal(m, n)));
    }
    this->addSurfaces(mesh, model, normals, mirrored);
    this->Builder.endObject();
  }

  void nameTextures()
  {
    std::vector<std::int32_t> used;
    for (std::size_t i = 0; i < this->Posed.size(); ++i)
    {
      used.push_back(this->Scene->meshes[this->Posed[i].mesh].material);
    }
    this->Materials.nameTextures(used);
  }

  void addSurfaces(const import::Mesh& mesh, const std::vector<std::uint32_t>& model,
    const std::vector<std::int32_t>& normals, bool mirrored)
  {
    SurfaceStyle style;
    style.material = this->Materials.add(mesh.material);
    style.twoSided = this->Builder.model().materials[static_cast<std::size_t>(style.material)].twoSided;
    style.shading = this->Format == "collada" ? Shading::Crease : Shading::Flat;
    if (!mesh.uvs.empty())
    {
      this->Builder.setHasUvs();
    }
    std::vector<Corner> corners;
    const std::uint32_t* at = mesh.faceVertices.data();
    for (const std::uint32_t size : mesh.faceSizes)
    {
      corners.clear();
      for (std::uint32_t i = 0; i < size; ++i)
      {
        corners.push_back(this->corner(mesh, model, normals, at[mirrored ? size - 1 - i : i]));
      }
      at += size;
      if (size == 2)
      {
        this->Builder.addLine(corners[0].vertex, corners[1].vertex);
      }
      else if (size == 1)
      {
        ++this->Points;
      }
      else
      {
        this->Builder.addSurface(corners, style);
      }
    }
  }

  void declare()
  {
    std::size_t declared = 0;
    for (const import::Material& material : this->Scene->materials)
    {
      declared += material.name != "DefaultMaterial" ? 1 : 0;
    }
    const std::int64_t ofFile = this->Scene->declaredMaterials;
    this->Builder.model().declaredMaterials = ofFile >= 0 ? static_cast<std::size_t>(ofFile) : declared;
    if (this->Points > 0)
    {
      this->Builder.warn(
        std::to_string(this->Points) + (this->Points == 1 ? " point is" : " points are") + " not drawn");
    }
  }

  void addAnimations()
  {
    Model& model = this->Builder.model();
    for (const import::Animation& from : this->Scene->animations)
    {
      Animation to;
      to.name = from.name.empty() ? "animation" + std::to_string(model.animations.size()) : from.name;
      to.fps = AssimpDeformation::fps;
      to.length = std::min(from.duration * to.fps, mostFrames);
      to.last = static_cast<int>(std::lround(to.length));
      model.animations.push_back(to);
      model.frames = std::max(model.frames, to.last + 1);
    }
  }

  std::string Path;
  std::string Format;
  std::shared_ptr<ImportedScene> Scene;
  ModelBuilder Builder;
  AssimpMaterials Materials;
  std::vector<PosedMesh> Posed;
  std::vector<std::vector<std::uint32_t>> First; ///< by mesh; empty when nothing is welded
  std::vector<std::uint32_t> SourceOf;           ///< of the model, where something is welded
  std::size_t Points = 0;
};
} // namespace

ModelContents readThroughAssimp(const std::string& path, const std::string& format, const ReadOptions& options)
{
  return Assembly(path, format, options).run();
}

} // namespace dgtk
