// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace dgtk::test
{

namespace
{
std::string brokenArrays(const Model& model)
{
  const std::size_t vertices = model.rest->positions.size();
  if (model.rest->normals.size() != vertices || model.sourceVertex.size() != vertices)
  {
    return "one normal and one source a vertex";
  }
  if (!model.uvs.empty() && model.uvs.size() != vertices)
  {
    return "one texture coordinate a vertex";
  }
  if (model.deformation ? model.normalGroup.size() != vertices : !model.normalGroup.empty())
  {
    return "one normal group a vertex of a deforming model";
  }
  if (std::any_of(model.sourceOf.begin(), model.sourceOf.end(),
        [&model](std::uint32_t source) { return source >= model.sourceVertices; }))
  {
    return "vertices of the file have sources";
  }
  for (std::size_t v = 0; v < vertices; ++v)
  {
    if (!model.rest->positions[v].allFinite())
    {
      return "positions are finite";
    }
    if (!(std::abs(model.rest->normals[v].norm() - 1) < 1e-5f))
    {
      return "normals have length one";
    }
    if (model.sourceVertex[v] >= model.sourceVertices)
    {
      return "sources exist";
    }
    if (!model.uvs.empty() && !model.uvs[v].allFinite())
    {
      return "texture coordinates are finite";
    }
  }
  return {};
}

std::string brokenParts(const Model& model)
{
  std::uint32_t next = 0;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    const Part& part = model.parts[p];
    if (part.firstTriangle != next || part.triangles == 0)
    {
      return "parts follow one another";
    }
    next += part.triangles;
    if (model.partOf(part.firstTriangle) != p || model.partOf(next - 1) != p)
    {
      return "partOf finds the part";
    }
    if (part.material < 0 || static_cast<std::size_t>(part.material) >= model.materials.size())
    {
      return "materials of parts exist";
    }
  }
  return next == model.triangles.size() ? "" : "every triangle is in a part";
}

std::string brokenBounds(const Model& model)
{
  for (const auto& triangle : model.triangles)
  {
    for (const std::uint32_t v : triangle)
    {
      if (v >= model.rest->positions.size())
      {
        return "vertices of triangles exist";
      }
      Eigen::Vector3d p = model.rest->positions[v];
      // bounds are in the file's axes; a left-handed POV-Ray file is mirrored in z
      p.z() *= model.format == "pov" && (p.z() < model.boundsMin.z() || p.z() > model.boundsMax.z()) ? -1 : 1;
      if ((p.array() < model.boundsMin.array()).any() || (p.array() > model.boundsMax.array()).any())
      {
        return "bounds hold every triangle";
      }
    }
  }
  return {};
}

std::string brokenMaterials(const Model& model)
{
  for (const Material& m : model.materials)
  {
    const auto inside = [](double value, double high) { return value >= 0 && value <= high; };
    if (!inside(m.opacity, 1) || !inside(m.shininess, 128) || !inside(m.diffuse.minCoeff(), 1) ||
        !inside(m.diffuse.maxCoeff(), 1) || m.texture >= static_cast<int>(model.textures.size()))
    {
      return "materials are in range";
    }
  }
  for (const Animation& a : model.animations)
  {
    if (a.first < 0 || a.last < a.first || a.last >= model.frames || !(a.fps >= 0))
    {
      return "animations lie in the frames";
    }
  }
  return {};
}
} // namespace

std::string brokenPromise(const Model& model)
{
  if (!model.rest)
  {
    return "there is a rest geometry";
  }
  for (const auto check : { brokenArrays, brokenParts, brokenBounds, brokenMaterials })
  {
    std::string broken = check(model);
    if (!broken.empty())
    {
      return broken;
    }
  }
  return {};
}

void expectNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " against " << b.transpose();
}

std::shared_ptr<const Model> readBytes(const std::string& extension, const std::string& bytes)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("model." + extension);
  writeFile(path, bytes);
  ReadOptions options;
  options.decodeTextures = false;
  return readModel(path, options);
}

std::string refusal(const std::string& extension, const std::string& bytes)
{
  const std::string text = thrownBy<InputError>([&] { readBytes(extension, bytes); });
  return text.substr(text.rfind("/model." + extension) + 1);
}

const char* const withoutExtraModels =
  "the sample models and their TRUTH.json are not part of the source: set DGTK_EXTRA_MODELS";

std::vector<std::string> extraPaths(const std::string& extension)
{
  std::vector<std::string> paths;
  if (!extraModels().empty() && std::filesystem::is_directory(extraModels()))
  {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(extraModels()))
    {
      if (entry.path().extension() == "." + extension && entry.file_size() > 0)
      {
        paths.push_back(entry.path().string());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> extraSeeds(const std::string& extension, std::size_t limit)
{
  std::string capitals = extension;
  std::transform(extension.begin(), extension.end(), capitals.begin(),
    [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
  std::vector<std::string> paths = extraPaths(extension);
  for (const std::string& path : extraPaths(capitals))
  {
    paths.push_back(path);
  }
  std::vector<std::string> seeds;
  for (const std::string& path : paths)
  {
    if (std::filesystem::file_size(path) <= limit)
    {
      seeds.push_back(contentsOf(path));
    }
  }
  return seeds;
}

} // namespace dgtk::test
