// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkModelBuilder.h"
#include "dgtkPovContents.h"

#include <algorithm>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
constexpr std::uint64_t mostPovCorners = 300'000;

class PovAssembly
{
public:
  PovAssembly(const std::string& path, const ReadOptions& options)
    : Scene(readPovContents(path))
    , Path(path)
    , Builder(path, "pov", this->Scene.bytesRead, options)
  {
  }

  ModelContents run()
  {
    this->checkSize();
    this->Builder.model().companions.assign(this->Scene.files.begin() + 1, this->Scene.files.end());
    for (const std::string& warning : this->Scene.warnings)
    {
      this->Builder.warn(warning);
    }
    for (std::size_t i = 0; i < this->Scene.shape.size(); ++i)
    {
      this->add(this->Scene.shape[i], i);
    }
    Model& model = this->Builder.model();
    model.declaredMaterials = this->Materials.size();
    model.declaredTriangles = this->trianglesOfRepeatedMeshes();
    ModelContents contents = this->Builder.finish();
    if (!this->Scene.rightHanded && contents.model->boundsMin.z() <= contents.model->boundsMax.z())
    {
      // bounds are in the file's axes
      double& low = contents.model->boundsMin.z();
      double& high = contents.model->boundsMax.z();
      std::swap(low = 0 - low, high = 0 - high);
    }
    return contents;
  }

private:
  /// Triangles as written when some mesh is drawn more than once, else 0.
  std::size_t trianglesOfRepeatedMeshes() const
  {
    std::set<const PovMesh*> meshes;
    std::size_t triangles = 0;
    for (const PovInstance& instance : this->Scene.shape)
    {
      triangles += meshes.insert(instance.mesh.get()).second ? instance.mesh->faces.size() : 0;
    }
    return meshes.size() < this->Scene.shape.size() ? triangles : 0;
  }

  void checkSize()
  {
    std::uint64_t corners = 0;
    const std::uint64_t most = mostPovCorners + this->Scene.bytesRead / 2;
    for (const PovInstance& instance : this->Scene.shape)
    {
      corners += 3 * instance.mesh->faces.size() + instance.mesh->vertices.size() + 1;
      if (corners > most)
      {
        throw InputError(this->Path, "repeats its meshes too often", "at most " + std::to_string(most) + " corners");
      }
    }
  }

  /// The scene is left-handed unless the camera says otherwise: mirrored in z, as Model is right-handed.
  Eigen::Affine3d modelFrom(const PovInstance& instance) const
  {
    Eigen::Affine3d model_from_scene = Eigen::Affine3d::Identity();
    model_from_scene(2, 2) = this->Scene.rightHanded ? 1 : -1;
    return model_from_scene * instance.scene_from_mesh;
  }

  const PovTexture& textureOf(const PovInstance& instance, const PovMesh::Face& face) const
  {
    const PovTexturePointer& own =
      face.texture >= 0 ? instance.mesh->textures[static_cast<std::size_t>(face.texture)] : instance.texture;
    return own ? *own : *this->Scene.defaultTexture;
  }

  int material(const PovTexture& texture)
  {
    const auto known = this->Materials.find(&texture);
    return known != this->Materials.end() ? known->second : this->Materials[&texture] = this->addMaterial(texture);
  }

  int addMaterial(const PovTexture& texture)
  {
    const PovPigment& pigment = texture.pigment;
    const PovFinish& finish = texture.finish;
    const Eigen::Vector3d plain = pigment.image.empty() ? Eigen::Vector3d(0.8, 0.8, 0.8) : Eigen::Vector3d(1, 1, 1);
    const Eigen::Vector3d color = pigment.hasColor && pigment.image.empty() ? pigment.color : plain;
    Material made;
    made.name = texture.name;
    made.diffuse = color * (finish.diffuse >= 0 ? finish.diffuse : 1);
    made.ambient = color * (finish.ambient >= 0 ? finish.ambient : 0.2);
    made.emission = color * finish.emission;
    const bool specular = finish.specular > 0;
    made.specular.setConstant(specular ? finish.specular : finish.phong);
    made.shininess = specular ? 1 / std::max(finish.roughness, 1e-3) : finish.phong > 0 ? finish.phongSize : 0;
    made.opacity = 1 - pigment.filter - pigment.transmit;
    made.twoSided = true;
    const int plainIndex = this->Builder.addMaterial(made);
    const int index = this->Builder.withTexture(plainIndex, this->Builder.addTexture(pigment.image));
    if (!pigment.image.empty() && !pigment.uvMapping && pigment.mapType != 0)
    {
      this->Builder.warn("image_map " + quoted(pigment.image) + " of that map_type is not drawn in its place");
    }
    return index;
  }

  /// Texture coordinates of a corner: those of the mesh, or for a planar image_map x and y.
  static Eigen::Vector2d uvOf(
    const PovInstance& instance, const PovMesh::Face& face, std::size_t corner, const PovPigment& pigment)
  {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    if (pigment.uvMapping || pigment.mapType != 0)
    {
      if (face.uv[corner] >= 0)
      {
        p.head<2>() = instance.mesh->uvs[static_cast<std::size_t>(face.uv[corner])].cast<double>();
      }
    }
    else
    {
      p = instance.mesh->vertices[face.vertex[corner]];
      p = face.texture >= 0 ? p : instance.texture_from_mesh * p;
    }
    const bool invertible = pigment.object_from_pattern.linear().determinant() != 0;
    return (invertible ? pigment.object_from_pattern.inverse() * p : p).head<2>();
  }

  void add(const PovInstance& instance, std::size_t index)
  {
    const PovMesh& mesh = *instance.mesh;
    const Eigen::Affine3d model_from_mesh = this->modelFrom(instance);
    const Eigen::Matrix3d& m = model_from_mesh.linear();
    const double orientation = m.determinant() < 0 ? -1 : 1;
    this->Builder.beginObject(instance.name.empty() ? "mesh" + std::to_string(index) : instance.name);
    this->Builder.model().isNumbered = this->Builder.model().isNumbered && mesh.isNumbered;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    {
      const std::uint32_t vertex = this->Builder.addVertex(model_from_mesh * mesh.vertices[i]);
      first = i == 0 ? vertex : first;
    }
    std::vector<std::int32_t> normals;
    for (const Eigen::Vector3f& normal : mesh.normals)
    {
      normals.push_back(this->Builder.addNormal(turnedNormal(m, orientation * normal.cast<double>())));
    }
    for (const PovMesh::Face& face : mesh.faces)
    {
      this->addFace(instance, face, first, normals, orientation < 0);
    }
    this->Builder.endObject();
  }

  /// Winding means nothing in the format: where there are normals, they say which side is outside.
  static bool turned(const PovMesh& mesh, const PovMesh::Face& face)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::int32_t normal : face.normal)
    {
      sum += normal < 0 ? Eigen::Vector3d(0, 0, 0) : mesh.normals[static_cast<std::size_t>(normal)].cast<double>();
    }
    const Eigen::Vector3d& a = mesh.vertices[face.vertex[0]];
    const Eigen::Vector3d own = (mesh.vertices[face.vertex[1]] - a).cross(mesh.vertices[face.vertex[2]] - a);
    return own.dot(sum) < 0;
  }

  void addFace(const PovInstance& instance, const PovMesh::Face& face, std::uint32_t first,
    const std::vector<std::int32_t>& normals, bool mirrored)
  {
    const PovTexture& texture = this->textureOf(instance, face);
    SurfaceStyle style;
    style.material = this->material(texture);
    style.twoSided = true;
    Corner corners[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      corners[i].vertex = first + face.vertex[i];
      corners[i].normal = face.normal[i] < 0 ? -1 : normals[static_cast<std::size_t>(face.normal[i])];
      if (!texture.pigment.image.empty() || face.uv[i] >= 0)
      {
        const Eigen::Vector2d uv = uvOf(instance, face, i, texture.pigment);
        corners[i].u = static_cast<float>(uv.x());
        corners[i].v = static_cast<float>(uv.y());
        this->Builder.setHasUvs();
      }
    }
    if (mirrored != turned(*instance.mesh, face))
    {
      std::swap(corners[1], corners[2]);
    }
    this->Builder.addSurface(corners, 3, style);
  }

  PovContents Scene;
  std::string Path;
  ModelBuilder Builder;
  std::map<const PovTexture*, int> Materials;
};
} // namespace

ModelContents readPov(const std::string& path, const ReadOptions& options);
ModelContents readPov(const std::string& path, const ReadOptions& options) { return PovAssembly(path, options).run(); }

} // namespace dgtk
