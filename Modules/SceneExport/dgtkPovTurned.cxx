// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovTurned.h"

#include "dgtkPovMeshes.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace dgtk
{

namespace
{
/// So many pixels of a triangle may show normals that face away: silhouettes of finely divided models keep the mesh
/// that all views share.
constexpr int fewPixels = 4;
/// The same where objects share a mesh, which would be written once for each of them.
constexpr int fewOfShared = 32;

/// Where the rays of a view come from, in a model's axes.
struct Viewer
{
  bool perspective = true;
  Eigen::Vector3d eye{ 0, 0, 0 };       ///< perspective
  Eigen::Vector3d direction{ 0, 0, 1 }; ///< of all rays, otherwise

  /// From the viewer to a point; its length means nothing.
  Eigen::Vector3d towards(const Eigen::Vector3d& point) const
  {
    return this->perspective ? Eigen::Vector3d(point - this->eye) : this->direction;
  }
};

/// A triangle in its model's axes. Positive is what faces away; as in shading, all normals are turned around when the
/// triangle is seen from behind.
class Shaded
{
public:
  Shaded(const Instance& instance, std::uint32_t triangle, const Viewer& viewer)
  {
    const Geometry& geometry = *instance.geometry;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint32_t vertex = instance.model->triangles[triangle][k];
      this->Corners[k] = geometry.positions[vertex];
      this->Normals[k] = geometry.normals[vertex].cast<double>();
    }
    const Eigen::Vector3d edges[] = { this->Corners[1] - this->Corners[0], this->Corners[2] - this->Corners[0] };
    this->Outward = edges[0].cross(edges[1]);
    const double side = this->Outward.dot(viewer.towards(this->Corners[0])) > 0 ? -1 : 1;
    const double area = this->Outward.squaredNorm();
    this->Slopes[1] = edges[1].cross(this->Outward) / area;
    this->Slopes[2] = this->Outward.cross(edges[0]) / area;
    this->Slopes[0] = -this->Slopes[1] - this->Slopes[2];
    this->Sound = area > 0 && this->Outward.dot(this->Normals[0] + this->Normals[1] + this->Normals[2]) > 0;
    for (Eigen::Vector3d& normal : this->Normals)
    {
      normal *= side;
    }
  }

  /// Whether some normal between the corners might face away: their products bound all. Not of triangles whose normals
  /// are those of the other side: POV-Ray turns them around for good.
  bool mayTurn(const Viewer& viewer) const
  {
    return this->Sound && std::any_of(this->Corners.begin(), this->Corners.end(),
                            [&](const Eigen::Vector3d& corner)
                            {
                              const Eigen::Vector3d towards = viewer.towards(corner);
                              return std::any_of(this->Normals.begin(), this->Normals.end(),
                                [&](const Eigen::Vector3d& normal) { return normal.dot(towards) > 0; });
                            });
  }

  /// The ray's parameter where it meets the triangle and the normal there faces away.
  std::optional<double> turnedAt(const CameraRay& ray) const
  {
    const double t = this->Outward.dot(this->Corners[0] - ray.origin) / this->Outward.dot(ray.direction);
    const Eigen::Vector3d point = ray.origin + t * ray.direction;
    Eigen::Vector3d normal(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double weight = this->weight(k, point);
      if (!(weight >= 0))
      {
        return std::nullopt;
      }
      normal += weight * this->Normals[k];
    }
    return normal.dot(ray.direction) >= 0 ? std::optional<double>(t) : std::nullopt;
  }

  /// The interpolated normal, a linear function of the place, times the way from the viewer.
  std::string function(const Viewer& viewer) const
  {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
    Eigen::Vector3d constant(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k)
    {
      linear += this->Normals[k] * this->Slopes[k].transpose();
      constant += this->Normals[k] * this->weight(k, Eigen::Vector3d(0, 0, 0));
    }
    const char* const axes[] = { "x", "y", "z" };
    std::string sum;
    for (int i = 0; i < 3; ++i)
    {
      std::string normal = povNumber(constant[i]);
      for (int j = 0; j < 3; ++j)
      {
        normal += " + " + povNumber(linear(i, j)) + " * " + axes[j];
      }
      const std::string way =
        viewer.perspective ? std::string(axes[i]) + " - " + povNumber(viewer.eye[i]) : povNumber(viewer.direction[i]);
      sum += (i > 0 ? " + (" : "(") + normal + ") * (" + way + ')';
    }
    return sum;
  }

  const std::array<Eigen::Vector3d, 3>& corners() const { return this->Corners; }

private:
  double weight(std::size_t corner, const Eigen::Vector3d& point) const
  {
    return (corner == 0 ? 1 : 0) + this->Slopes[corner].dot(point - this->Corners[0]);
  }

  std::array<Eigen::Vector3d, 3> Corners;
  std::array<Eigen::Vector3d, 3> Normals;
  std::array<Eigen::Vector3d, 3> Slopes; ///< of the weights
  Eigen::Vector3d Outward;
  bool Sound = false; ///< the normals are on the triangle's own side
};

/// A view of an instance.
class ModelView
{
public:
  ModelView(const Instance& instance, const View& view)
    : TheView(view)
    , Camera_from_model(view.camera_from_world * instance.world_from_object)
    , Model_from_camera(this->Camera_from_model.linear.inverse())
  {
    this->Seen.perspective = view.model->linear()->perspective;
    this->Seen.eye = this->Model_from_camera * -this->Camera_from_model.translation;
    this->Seen.direction = this->Model_from_camera.col(2);
  }

  const Viewer& viewer() const { return this->Seen; }

  /// Whether normals that face away take more than `few` of the pixels that a triangle covers.
  bool showsTurned(const Shaded& triangle, int few) const
  {
    const auto [low, high] = this->pixelsOf(triangle);
    int pixels = 0;
    for (int y = low.y(); y < high.y(); ++y)
    {
      for (int x = low.x(); x < high.x(); ++x)
      {
        const std::optional<double> depth = triangle.turnedAt(this->rayThrough(x, y));
        pixels += depth && *depth >= this->TheView.near && *depth <= this->TheView.far ? 1 : 0;
        if (pixels > few)
        {
          return true;
        }
      }
    }
    return false;
  }

private:
  CameraRay rayThrough(int x, int y) const
  {
    const CameraRay ray = this->TheView.model->rayThrough({ x + 0.5, y + 0.5 });
    return { this->Model_from_camera * (ray.origin - this->Camera_from_model.translation),
      this->Model_from_camera * ray.direction };
  }

  /// Corners of what a triangle has beyond the near plane, camera frame.
  std::vector<Eigen::Vector3d> before(const Shaded& triangle) const
  {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d p = this->Camera_from_model * triangle.corners()[k];
      const Eigen::Vector3d q = this->Camera_from_model * triangle.corners()[(k + 1) % 3];
      if (p.z() >= this->TheView.near)
      {
        points.push_back(p);
      }
      if ((p.z() >= this->TheView.near) != (q.z() >= this->TheView.near))
      {
        points.push_back(p + (q - p) * ((this->TheView.near - p.z()) / (q.z() - p.z())));
      }
    }
    return points;
  }

  /// First pixel and the one behind the last of a box around what the image may show of a triangle.
  std::array<Eigen::Vector2i, 2> pixelsOf(const Shaded& triangle) const
  {
    const Eigen::Array2d size(this->TheView.model->width(), this->TheView.model->height());
    Eigen::Array2d low = size;
    Eigen::Array2d high(0, 0);
    for (const Eigen::Vector3d& point : this->before(triangle))
    {
      Eigen::Vector2d pixel;
      if (this->TheView.model->project(point, pixel))
      {
        low = low.min(pixel.array());
        high = high.max(pixel.array());
      }
    }
    return { low.floor().max(0).matrix().cast<int>(), high.ceil().min(size).matrix().cast<int>() };
  }

  const View& TheView;
  Affine3 Camera_from_model;
  Eigen::Matrix3d Model_from_camera;
  Viewer Seen;
};

/// Adds a texture for each turned triangle; those of the materials become declared ones.
void addTurned(
  PovText& text, const std::string& name, const Instance& instance, PovTextures& textures, const PovTurned& turned)
{
  const std::vector<Material>& materials = povMaterialsOf(instance);
  for (const Part& part : instance.model->parts)
  {
    const std::size_t material = static_cast<std::size_t>(part.material);
    const int index = textures.ofMaterial[material];
    const std::string plain = name + '_' + std::to_string(index);
    const std::string behind = plain + "_turned";
    const auto end = turned.lower_bound(part.firstTriangle + part.triangles);
    for (auto at = turned.lower_bound(part.firstTriangle); at != end; ++at)
    {
      std::string& known = textures.list[static_cast<std::size_t>(index)];
      const std::string named = "texture { " + plain + " }";
      if (known != named)
      {
        text << "#declare " + plain + " = " + known + "\n#declare " + behind + " = texture { " + plain +
                  " finish { diffuse 0, " + povNumber(materials[material].diffuse.maxCoeff()) +
                  " phong 0 specular 0 } }\n";
        known = named;
      }
      textures.ofTriangle[at->first] = static_cast<int>(textures.list.size());
      textures.list.push_back("texture { function { select(" + at->second + ", 0, 1) } texture_map { [0.5 " + plain +
                              "] [0.5 " + behind + "] } }");
    }
  }
}
} // namespace

PovTurned povTurned(const Instance& instance, const View& view, bool shared)
{
  PovTurned turned;
  if (instance.world_from_object.linear.determinant() == 0)
  {
    return turned;
  }
  const ModelView seen(instance, view);
  const std::vector<Material>& materials = povMaterialsOf(instance);
  for (const Part& part : instance.model->parts)
  {
    const bool lit = materials[static_cast<std::size_t>(part.material)].diffuse.maxCoeff() > 0;
    for (std::uint32_t i = 0; lit && i < part.triangles; ++i)
    {
      const Shaded triangle(instance, part.firstTriangle + i, seen.viewer());
      if (triangle.mayTurn(seen.viewer()) && seen.showsTurned(triangle, shared ? fewOfShared : fewPixels))
      {
        turned.emplace(part.firstTriangle + i, triangle.function(seen.viewer()));
      }
    }
  }
  return turned;
}

void povDeclareMesh(
  PovText& text, const std::string& name, const Instance& instance, PovTextures textures, const PovTurned& turned)
{
  if (!turned.empty())
  {
    addTurned(text, name, instance, textures, turned);
  }
  text << "#declare " + name + " = mesh2 ";
  povWriteMesh(text, instance, textures);
}

} // namespace dgtk
