// SPDX-License-Identifier: BSD-3-Clause
// The files of models against the triangles of the scene's first frame, by a reader of its own.
#include "dgtkCheck.h"

#include "dgtkHash.h"
#include "dgtkPlyFile.h"
#include "dgtkTextureFile.h"

#include <array>
#include <filesystem>
#include <set>

namespace dgtk
{

namespace
{
/// Steps of 8 bits.
constexpr double colorTolerance = 0.500001;

class ModelCheck
{
public:
  ModelCheck(const Dataset& dataset, const std::string& file, const Instance& instance)
    : Owner(dataset)
    , File(file)
    , TheInstance(instance)
    , Ply(dataset.absolute(file))
  {
  }

  void run(Meter& shapes, Meter& looks, std::vector<std::string>& files)
  {
    files.push_back(this->File);
    const Model& model = *this->TheInstance.model;
    shapes.equal(
      this->Ply.isWellFormed(), [&] { return this->offender("another header or end", "those of its vertices"); });
    shapes.equal(this->Ply.triangles() == model.triangles.size(),
      [&]
      {
        return this->offender(
          std::to_string(this->Ply.triangles()) + " triangles", std::to_string(model.triangles.size()));
      });
    for (std::size_t t = 0; t < std::min(this->Ply.triangles(), model.triangles.size()); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->corner(t, k, shapes, looks);
      }
      this->picture(t, looks);
    }
    for (const std::string& picture : this->Ply.pictures())
    {
      files.push_back("models/" + picture);
    }
  }

private:
  Offender offender(const std::string& found, const std::string& expected) const
  {
    return { this->File, -1, -1, found, expected };
  }
  static std::string cornerName(std::size_t triangle, int k)
  {
    return "corner " + std::to_string(k) + " of triangle " + std::to_string(triangle);
  }

  void corner(std::size_t t, int k, Meter& shapes, Meter& looks) const
  {
    const Model& model = *this->TheInstance.model;
    const std::uint32_t vertex = model.triangles[t][std::size_t(k)];
    const Eigen::Vector3d& x = this->TheInstance.geometry->positions[vertex];
    const PlyVertex& found = this->Ply.corner(t, k);
    const bool same = found.x == x && found.normal == this->TheInstance.geometry->normals[vertex] &&
                      this->Ply.hasUvs() != model.uvs.empty() && (model.uvs.empty() || found.uv == model.uvs[vertex]);
    shapes.equal(same, [&]
      { return this->offender(cornerName(t, k) + ' ' + numbersText(found.x.data(), 3), numbersText(x.data(), 3)); });
    if (model.colorMap)
    {
      looks.skip();
      return;
    }
    Eigen::Vector3d color = this->materialOf(t).diffuse * 255;
    for (int i = 0; i < 3 && !model.colors.empty(); ++i)
    {
      color[i] *= model.colors[vertex][std::size_t(i)] / 255.0;
    }
    for (int i = 0; i < 3; ++i)
    {
      const double value = found.color[std::size_t(i)];
      looks.add(value - color[i],
        [&] { return this->offender(cornerName(t, k) + " colour " + numberText(value), numberText(color[i])); });
    }
  }

  const Material& materialOf(std::size_t triangle) const
  {
    const Part& part = this->TheInstance.model->parts[this->TheInstance.model->partOf(std::uint32_t(triangle))];
    return (*this->TheInstance.materials)[std::size_t(part.material)];
  }

  static std::string wrapText(const Texture& texture)
  {
    constexpr std::array<const char*, 3> words{ "repeat", "clamp", "mirror" };
    return texture.repeats()
             ? std::string()
             : std::string(words[std::size_t(texture.wrap[0])]) + ' ' + words[std::size_t(texture.wrap[1])];
  }

  /// The file beside the model is the texture's own, or shows the picture that is in the model's file.
  bool isPicture(const std::string& path, const Texture& texture) const
  {
    if (!this->TheInstance.model->holds(texture))
    {
      return hashOfFile(path) == hashOfFile(texture.path);
    }
    std::string problem;
    const std::shared_ptr<const Image> image = decodeTexture(path, problem);
    return image && image->width == texture.image->width && image->rgba == texture.image->rgba;
  }

  void picture(std::size_t triangle, Meter& looks)
  {
    const int index = this->materialOf(triangle).texture;
    const Texture* const texture = index < 0 ? nullptr : &this->TheInstance.model->textures[std::size_t(index)];
    const std::string name = this->Ply.picture(triangle);
    if (texture == nullptr || !texture->image)
    {
      looks.equal(name.empty(), [&] { return this->offender("picture '" + name + '\'', "none"); });
      return;
    }
    if (!this->Seen.insert({ name, texture }).second)
    {
      return;
    }
    const std::string path = this->Owner.absolute("models/" + name);
    const bool same = !name.empty() && this->isPicture(path, *texture);
    looks.equal(same, [&] { return this->offender("picture '" + name + '\'', "that of '" + texture->path + '\''); });
    const std::string wrap = wrapText(*texture);
    const std::string found = this->Ply.wrap(triangle);
    looks.equal(found == wrap, [&] { return this->offender('\'' + name + "' wrapped '" + found + '\'', wrap); });
  }

  const Dataset& Owner;
  std::string File;
  const Instance& TheInstance;
  PlyFile Ply;
  std::set<std::pair<std::string, const Texture*>> Seen;
};
} // namespace

void checkModels(Dataset& dataset, Results& results)
{
  const std::shared_ptr<const SceneState> state = dataset.stage().at(dataset.stage().description().firstFrame());
  const std::vector<ObjectRecord>& objects = dataset.objects();
  Meter shapes(0);
  Meter looks(colorTolerance);
  std::vector<std::string> files;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < std::min(objects.size(), state->instances.size()); ++i)
  {
    const std::string& file = objects[i].geometryFile;
    if (file.empty() || !seen.insert(file).second)
    {
      continue;
    }
    const std::string expected = "models/" + objects[i].geometry.substr(0, 16) + ".ply";
    shapes.equal(file == expected,
      [&] {
        return Offender{ "objects.json", -1, -1, "geometry_file " + file, expected };
      });
    if (file == expected)
    {
      ModelCheck(dataset, file, state->instances[i]).run(shapes, looks, files);
    }
  }
  for (const DatasetFile& one : dataset.manifest().files)
  {
    const std::filesystem::path path(one.path);
    const bool model = path.parent_path() == "models" && path.extension() == ".ply";
    shapes.equal(!model || seen.count(one.path) > 0,
      [&] {
        return Offender{ "objects.json", -1, -1, "no object has " + one.path, "a geometry_file" };
      });
  }
  if (!seen.empty() || shapes.Bad > 0)
  {
    results.add({ "shapes", "", files }, shapes);
    results.add({ "looks", "step of 8 bits", files }, looks);
  }
}

} // namespace dgtk
