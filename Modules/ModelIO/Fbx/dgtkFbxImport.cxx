// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxImport.h"

#include "dgtkFbxDeformers.h"
#include "dgtkFbxGeometry.h"
#include "dgtkFbxMaterials.h"
#include "dgtkFbxMotion.h"
#include "dgtkJointPose.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace dgtk::import
{

namespace
{
constexpr std::int64_t oldestVersion = 7000;
constexpr std::uint64_t memoryBase = std::uint64_t(64) << 20;
constexpr std::uint64_t memoryPerByte = 8;

Joint jointOf(const FbxObject& model)
{
  Joint joint;
  joint.translation = model.vector("Lcl Translation", {});
  joint.rotation = model.vector("Lcl Rotation", {});
  joint.scale = model.vector("Lcl Scaling", { 1, 1, 1 });
  const std::int64_t inherit = model.integer("InheritType", 1);
  joint.inherit = inherit == 0 ? Inherit::RrSs : inherit == 2 ? Inherit::Rrs : Inherit::RSrs;
  // or else orders and turns before and after do not count
  const bool isTurned = model.integer("RotationActive", 0) != 0 && model.integer("RotationSpaceForLimitOnly", 0) == 0;
  constexpr std::array<std::int32_t, 3> orders[] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 2, 0 }, { 1, 0, 2 }, { 2, 0, 1 },
    { 2, 1, 0 } };
  const std::int64_t order = isTurned ? model.integer("RotationOrder", 0) : 0;
  joint.order = orders[order > 0 && order < 6 ? order : 0];
  const auto shift = [&model](const char* name) { return Transform::shift(model.vector(name, {})); };
  const auto turn = [&model, isTurned](const char* name) {
    return Transform::turn(isTurned ? model.vector(name, {}) : std::array<double, 3>{}, { 0, 1, 2 });
  };
  const Transform pivot = shift("RotationPivot");
  const Transform scalePivot = shift("ScalingPivot");
  joint.before = (shift("RotationOffset") * pivot * turn("PreRotation")).matrix();
  joint.middle = (turn("PostRotation").inverse() * pivot.inverse() * shift("ScalingOffset") * scalePivot).matrix();
  joint.after = scalePivot.inverse().matrix();
  return joint;
}

class Import
{
public:
  Import(const FbxElement& document, Scene& to)
    : File(document)
    , To(to)
    , Materials(this->File, to)
  {
    this->Targets.nodes.assign(this->File.objects().size(), noIndex);
  }

  void run()
  {
    this->To.nodes.emplace_back().name = "RootNode";
    this->To.nodes.back().parent_from_node = Transform().matrix();
    this->addModels();
    for (std::size_t i = 0; i < this->File.objects().size(); ++i)
    {
      if (this->Targets.nodes[i] != noIndex)
      {
        this->addMeshes(i);
      }
    }
    this->To.animations = readFbxAnimations(this->File, this->Targets);
    if (this->BadPolygons > 0)
    {
      this->To.warnings.push_back(std::to_string(this->BadPolygons) +
                                  (this->BadPolygons == 1 ? " surface" : " surfaces") +
                                  " left out: a vertex that does not exist");
    }
    if (this->HasColors)
    {
      this->To.warnings.emplace_back("colours of vertices are not drawn");
    }
  }

private:
  void addModels()
  {
    std::vector<std::pair<std::size_t, std::int32_t>> open; // models, and the nodes above them
    const auto push = [&](std::size_t parent, std::int32_t node)
    {
      const std::vector<std::size_t> children = this->File.childrenOf(parent, "Model");
      std::for_each(children.rbegin(), children.rend(), [&](std::size_t child) { open.emplace_back(child, node); });
    };
    push(0, 0);
    while (!open.empty())
    {
      const auto [index, above] = open.back();
      open.pop_back();
      std::int32_t& own = this->Targets.nodes[index];
      if (own != noIndex)
      {
        continue; // a model has one place
      }
      own = static_cast<std::int32_t>(this->To.nodes.size());
      const FbxObject& model = this->File.object(index);
      Node& made = this->To.nodes.emplace_back();
      made.name = model.name;
      made.parent = above;
      made.parent_from_node = Transform().matrix();
      made.joint.push_back(jointOf(model));
      this->addGeometryNode(model, own);
      push(index, own);
    }
  }

  static Transform placementOf(const FbxObject& model)
  {
    return Transform::shift(model.vector("GeometricTranslation", {})) *
           Transform::turn(model.vector("GeometricRotation", {}), { 0, 1, 2 }) *
           Transform::scale(model.vector("GeometricScaling", { 1, 1, 1 }));
  }

  /// What a geometric transform moves hangs on a node of its own, behind the model's, which its children do not see.
  void addGeometryNode(const FbxObject& model, std::int32_t node)
  {
    const Transform placed = placementOf(model);
    if (!placed.isIdentity())
    {
      Node& own = this->To.nodes.emplace_back();
      own.name = model.name;
      own.parent = node;
      own.parent_from_node = placed.matrix();
    }
  }

  void addMeshes(std::size_t index)
  {
    const Transform placed = placementOf(this->File.object(index));
    const std::int32_t node = this->Targets.nodes[index] + (placed.isIdentity() ? 0 : 1);
    const std::vector<std::size_t> materials = this->File.childrenOf(index, "Material");
    for (const std::size_t geometry : this->File.childrenOf(index, "Geometry"))
    {
      if (!this->File.object(geometry).is("Geometry", "Mesh"))
      {
        continue;
      }
      const std::vector<std::uint32_t> meshes = this->meshesOf(geometry, materials, placed);
      std::vector<std::uint32_t>& list = this->To.nodes[static_cast<std::size_t>(node)].meshes;
      list.insert(list.end(), meshes.begin(), meshes.end());
    }
  }

  std::vector<std::uint32_t> meshesOf(
    std::size_t geometry, const std::vector<std::size_t>& materials, const Transform& placed)
  {
    const auto [known, isNew] = this->Meshes.try_emplace({ geometry, materials, placed.matrix() });
    if (!isNew)
    {
      return known->second;
    }
    const FbxGeometry from(*this->File.object(geometry).element);
    this->BadPolygons += from.badPolygons();
    this->HasColors = this->HasColors || from.hasColors();
    const FbxDeformers deformers(this->File, geometry, placed, this->Targets);
    for (const FbxPart& part : from.parts())
    {
      Mesh mesh = part.mesh;
      mesh.name = this->File.object(geometry).name;
      const bool isKnown = part.slot < materials.size();
      mesh.material = isKnown             ? this->Materials.indexOf(materials[part.slot])
                      : materials.empty() ? this->Materials.other()
                                          : this->Materials.indexOf(materials[0]);
      this->placeTexture(from, part, mesh);
      deformers.addTo(part, from.controlPoints(), mesh);
      known->second.push_back(static_cast<std::uint32_t>(this->To.meshes.size()));
      this->To.meshes.push_back(std::move(mesh));
    }
    return known->second;
  }

  void placeTexture(const FbxGeometry& from, const FbxPart& part, Mesh& mesh) const
  {
    const FbxPlacement& placement = this->Materials.placement(mesh.material);
    mesh.uvs = from.uvs(part, placement.uvSet);
    const std::array<double, 6>& m = placement.picture_from_uv;
    for (std::array<float, 2>& uv : mesh.uvs)
    {
      uv = { float(m[0] * double(uv[0]) + m[1] * double(uv[1]) + m[2]),
        float(m[3] * double(uv[0]) + m[4] * double(uv[1]) + m[5]) };
    }
  }

  FbxScene File;
  Scene& To;
  FbxMaterials Materials;
  FbxTargets Targets;
  std::map<std::tuple<std::size_t, std::vector<std::size_t>, Matrix>, std::vector<std::uint32_t>> Meshes;
  std::size_t BadPolygons = 0;
  bool HasColors = false;
};
} // namespace

void readFbx(const std::string& bytes, Scene& to)
{
  const FbxElement document = readFbxDocument(bytes, memoryBase + memoryPerByte * bytes.size());
  const std::int64_t version = fbxVersion(bytes, document);
  if (version < oldestVersion)
  {
    throw std::runtime_error(
      version == 0 ? "has nothing of an FBX file"
                   : "has version " + std::to_string(version) + " of FBX: 7000 (FBX 2011) and later are read");
  }
  Import(document, to).run();
}

} // namespace dgtk::import
