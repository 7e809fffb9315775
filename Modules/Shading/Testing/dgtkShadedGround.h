// SPDX-License-Identifier: BSD-3-Clause
// A plane under lights, and pictures of it.
#ifndef dgtkShadedGround_h
#define dgtkShadedGround_h

#include "dgtkRayPictures.h"

#include "dgtkSyntheticScene.h"
#include "dgtkThreadPool.h"

#include <Eigen/Geometry>

#include <functional>
#include <memory>

namespace dgtk::test
{

constexpr double step = 1.0 / 255;

struct Picture
{
  ColorBuffer colors;
  VisibilityBuffer hits;
  double at(int x, int y, int channel = 0) const
  {
    return double(this->colors.rgb[(std::size_t(y) * this->colors.rect.width + x) * 3 + channel]);
  }
};

inline Picture draw(const std::shared_ptr<const SceneState>& state, const View& view, int samples = 1, int threads = 2)
{
  ThreadPool pool(threads);
  const auto source = makeRayPictures(pool);
  source->setScene(state, view);
  Picture picture;
  source->renderColor({ 0, 0, view.model->width(), view.model->height() }, samples, picture.colors, &picture.hits);
  return picture;
}

/// White, with the normals of its triangles; `round`: those of a ball around the middle of its vertices.
inline std::shared_ptr<Model> matte(const std::shared_ptr<Model>& from, bool round = false)
{
  auto model = std::make_shared<Model>(*from);
  auto geometry = std::make_shared<Geometry>();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : from->rest->positions)
  {
    middle += x / double(from->rest->positions.size());
  }
  model->uvs.clear();
  for (auto& triangle : model->triangles)
  {
    Eigen::Vector3d x[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      x[i] = from->rest->positions[triangle[i]];
      model->uvs.push_back(from->uvs[triangle[i]]);
    }
    const Eigen::Vector3d flat = (x[1] - x[0]).cross(x[2] - x[0]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      triangle[i] = std::uint32_t(geometry->positions.size());
      geometry->positions.push_back(x[i]);
      geometry->normals.push_back((round ? Eigen::Vector3d(x[i] - middle) : flat).normalized().cast<float>());
    }
  }
  model->rest = geometry;
  model->materials.assign(1, Material{});
  model->materials[0].ambient.setZero();
  model->materials[0].diffuse.setOnes();
  return model;
}

inline LightState lightAt(LightKind kind, const Eigen::Vector3d& position, const Eigen::Vector3d& target = { 0, 0, 0 })
{
  LightState light;
  light.kind = kind;
  light.position = position;
  light.target = target;
  return light;
}

/// The plane y = 0.
inline std::shared_ptr<Model> groundModel(double half = 4)
{
  QuadOptions floor;
  floor.corner = { -half, 0, half };
  floor.sideU = { 2 * half, 0, 0 };
  floor.sideV = { 0, 0, -2 * half };
  return matte(makeQuad(floor));
}

inline SceneBuilder ground(double half = 4) { return SceneBuilder().add(groundModel(half)); }

inline View fromAbove()
{
  ViewOptions options;
  options.width = 160;
  options.height = 120;
  options.eye = { 0.5, 6, 4 };
  return makeView(options);
}

inline Eigen::Vector3d onGround(const View& view, int x, int y)
{
  const CameraRay ray = view.model->rayThrough({ x + 0.5, y + 0.5 });
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  const Eigen::Vector3d eye = world_from_camera * ray.origin;
  const Eigen::Vector3d d = world_from_camera.rotation * ray.direction;
  return eye - d * (eye.y() / d.y());
}

/// Calls body(x, y, point) for pixels that show the ground.
inline int forGround(
  const View& view, const Picture& picture, const std::function<void(int, int, const Eigen::Vector3d&)>& body)
{
  int count = 0;
  for (int y = 0; y < view.model->height(); ++y)
  {
    for (int x = 0; x < view.model->width(); ++x)
    {
      if (picture.hits.at(x, y).object == 1)
      {
        body(x, y, onGround(view, x, y));
        ++count;
      }
    }
  }
  return count;
}

} // namespace dgtk::test

#endif
