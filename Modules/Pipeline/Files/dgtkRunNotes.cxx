// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunNotes.h"

#include "dgtkError.h"
#include "dgtkLayers.h"
#include "dgtkPovRenderOptions.h"
#include "dgtkRenderGLCalls.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

namespace dgtk
{

std::string emptyLine(const std::vector<EmptyRecord>& empty)
{
  std::string without;
  std::string partly;
  for (const EmptyRecord& one : empty)
  {
    const bool whole = one.pictures == one.of;
    std::string& list = whole ? without : partly;
    list += (list.empty() ? "" : ", ") + one.layer;
    list += whole ? "" : " (" + std::to_string(one.pictures) + " of " + std::to_string(one.of) + ')';
  }
  without = without.empty() ? "" : "layers without a file: " + without;
  partly = partly.empty() ? "" : "layers without a file for some pictures: " + partly;
  return without + (without.empty() || partly.empty() ? "" : "; ") + partly;
}

namespace
{
struct Box
{
  Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d most = -least;
};

Box boxOf(const Geometry& geometry)
{
  Box box;
  for (const Eigen::Vector3d& position : geometry.positions)
  {
    box.least = box.least.cwiseMin(position);
    box.most = box.most.cwiseMax(position);
  }
  return box;
}

/// Values that are negative outside one side of what a camera sees, of a point in its frame; linear in the point.
Eigen::Matrix<double, 6, 1> sidesOf(const View& view, const LinearProjection& lens, const Eigen::Vector3d& x_in_camera)
{
  const double w = lens.perspective ? x_in_camera.z() : 1;
  const Eigen::Vector3d pixel = lens.K * Eigen::Vector3d(x_in_camera.x(), x_in_camera.y(), w);
  Eigen::Matrix<double, 6, 1> sides;
  sides << pixel.x(), view.model->width() * w - pixel.x(), pixel.y(), view.model->height() * w - pixel.y(),
    x_in_camera.z() - view.near, view.far - x_in_camera.z();
  return sides;
}

/// Whether a box reaches into the frustum, as far as its planes tell.
bool reaches(const View& view, const LinearProjection& lens, const Box& box, const Affine3& world_from_object)
{
  Eigen::Matrix<double, 6, 1> most = Eigen::Matrix<double, 6, 1>::Constant(-std::numeric_limits<double>::infinity());
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d point((corner & 1 ? box.most : box.least).x(), (corner & 2 ? box.most : box.least).y(),
      (corner & 4 ? box.most : box.least).z());
    most = most.cwiseMax(sidesOf(view, lens, view.camera_from_world * (world_from_object * point)));
  }
  return (most.array() >= 0).all();
}

constexpr std::size_t mostLookedAt = 64; // pictures of a run, for how coarse shadows are

bool castsShadows(const SceneDescription& scene)
{
  return std::any_of(
    scene.lights.begin(), scene.lights.end(), [](const auto& light) { return isEver(light.enabled) && light.shadows; });
}

bool seesAnything(const View& view, const SceneState& state, std::map<const Geometry*, Box>& boxes)
{
  const auto lens = view.model->linear();
  return !lens || std::any_of(state.instances.begin(), state.instances.end(),
                    [&](const Instance& instance)
                    {
                      const auto [box, isNew] = boxes.try_emplace(instance.geometry.get());
                      box->second = isNew ? boxOf(*instance.geometry) : box->second;
                      return instance.visible && reaches(view, *lens, box->second, instance.world_from_object);
                    });
}

/// A scene without surfaces, and cameras whose frustum holds no object's box at any frame of the run.
std::vector<std::string> blindPictures(const WorkPlan& plan, const Stage& stage)
{
  if (stage.objectNames().empty())
  {
    return { "the scene has no object with a surface: its pictures are empty" };
  }
  std::set<std::size_t> blind;
  for (const Job& job : plan.jobs)
  {
    blind.insert(job.camera);
  }
  for (auto job = plan.jobs.begin(); job != plan.jobs.end() && !blind.empty();)
  {
    // boxes are known for the geometry of one state, which keeps it
    const std::shared_ptr<const SceneState> state = stage.at(job->frame);
    std::map<const Geometry*, Box> boxes;
    for (const int frame = job->frame; job != plan.jobs.end() && job->frame == frame; ++job)
    {
      if (blind.count(job->camera) != 0 &&
          seesAnything(stage.view(job->camera, frame, plan.request.width, plan.request.height), *state, boxes))
      {
        blind.erase(job->camera);
      }
    }
  }
  std::vector<std::string> lines;
  lines.reserve(blind.size());
  for (const std::size_t camera : blind)
  {
    lines.push_back("camera " + quoted(stage.cameraNames()[camera]) + " sees no object at any frame of this run");
  }
  return lines;
}

/// Of shadow maps: none where OpenGL does not make the colours.
std::vector<std::string> coarseShadowLines(const WorkPlan& plan, const Stage& stage)
{
  if (!plan.drawsColor() || !plan.drawn || !castsShadows(stage.description()))
  {
    return {};
  }
  struct Worst
  {
    double pixels = 0;
    int size = 0;
    Job job;
  };
  std::map<std::string, Worst> coarse; // by the light's name
  const std::size_t step = (plan.jobs.size() + mostLookedAt - 1) / mostLookedAt;
  std::shared_ptr<const SceneState> state;
  for (std::size_t i = 0; i < plan.jobs.size(); i += step)
  {
    const Job& job = plan.jobs[i];
    if (!state || state->frame != job.frame)
    {
      state = stage.at(job.frame);
    }
    const View view = stage.view(job.camera, job.frame, plan.request.width, plan.request.height);
    for (const CoarseShadow& found : renderGL().coarseShadows(*state, view))
    {
      const LightState& light = state->lights[found.light];
      Worst& worst = coarse[light.name];
      worst = found.pixels > worst.pixels ? Worst{ found.pixels, light.shadowSize, job } : worst;
    }
  }
  std::vector<std::string> lines;
  lines.reserve(coarse.size());
  for (const auto& [light, worst] : coarse)
  {
    lines.push_back("light " + quoted(light) + ": its shadows are coarse: a texel of the map (shadowSize " +
                    std::to_string(worst.size) + ") is up to " + std::to_string(std::lround(worst.pixels)) +
                    " pixels large (camera " + quoted(stage.cameraNames()[worst.job.camera]) + ", frame " +
                    std::to_string(worst.job.frame) + ')');
  }
  return lines;
}

} // namespace

std::string placelessLine(const std::string& line, const SceneDescription& scene)
{
  const std::string prefix = scene.folder.empty() ? std::string() : scene.folder + '/';
  std::string text = line;
  for (std::size_t at = 0; !prefix.empty() && (at = text.find(prefix, at)) != std::string::npos;)
  {
    const bool begins = at == 0 || (at >= 2 && text.compare(at - 2, 2, ": ") == 0);
    text.erase(at, begins ? prefix.size() : 0);
    at += begins ? 0 : prefix.size();
  }
  return text;
}

std::vector<std::string> pictureNotes(const WorkPlan& plan, const Stage& stage)
{
  std::vector<std::string> notes;
  const auto add = [&notes](const std::vector<std::string>& lines)
  {
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(notes),
      [&notes](const std::string& line) { return std::find(notes.begin(), notes.end(), line) == notes.end(); });
  };
  add(blindPictures(plan, stage));
  add(coarseShadowLines(plan, stage));
  if (!drawsItself(plan.request) && plan.drawsColor())
  {
    const Job& first = plan.jobs.front();
    add(povLines(*stage.at(first.frame), stage.view(first.camera, first.frame, plan.request.width, plan.request.height),
      plan.request.options));
  }
  for (const PlannedLayer& planned : plan.layers)
  {
    add(planned.layer->notes(plan, stage));
  }
  return notes;
}

} // namespace dgtk
