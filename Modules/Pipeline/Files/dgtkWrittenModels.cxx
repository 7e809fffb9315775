// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWrittenModels.h"

#include "dgtkColorMap.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkLayerWriter.h"
#include "dgtkText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace dgtk
{

namespace
{
constexpr std::size_t nameDigits = 16;
constexpr double most8 = 255;
using Color = std::array<std::uint8_t, 3>;

/// The picture of a material's diffuse colour; null where it has none, or one that was not found.
const Texture* textureOf(const Model& model, const Material& material)
{
  const Texture* const texture = material.texture < 0 ? nullptr : &model.textures[std::size_t(material.texture)];
  return texture != nullptr && texture->image ? texture : nullptr;
}

/// "clamp mirror": what there is of a picture beyond it, along u and v; "" where it repeats.
std::string wrapOf(const Texture& texture)
{
  const auto word = [](TextureWrap wrap) {
    return wrap == TextureWrap::Clamp ? "clamp" : wrap == TextureWrap::Mirror ? "mirror" : "repeat";
  };
  return texture.repeats() ? std::string() : std::string(word(texture.wrap[0])) + ' ' + word(texture.wrap[1]);
}

Color colorOf(const Model& model, const Material& material, std::uint32_t vertex)
{
  const auto own = vertexColor(model, vertex);
  const Eigen::Vector3d color =
    (Eigen::Vector3d(own[0], own[1], own[2]) / most8).cwiseProduct(material.diffuse) * most8;
  Color bytes;
  for (int i = 0; i < 3; ++i)
  {
    bytes[std::size_t(i)] = static_cast<std::uint8_t>(std::lround(std::clamp(color[i], 0.0, most8)));
  }
  return bytes;
}

template <typename T>
void append(std::string& bytes, const T* values, std::size_t count)
{
  bytes.append(reinterpret_cast<const char*>(values), sizeof(T) * count);
}

/// Vertices and triangles of a .ply; a vertex for each colour that its parts give it.
class PlyBody
{
public:
  PlyBody(const Instance& instance, const std::vector<const Texture*>& textures)
    : TheInstance(instance)
    , Textures(textures)
  {
    const std::vector<Part>& parts = instance.model->parts;
    this->HasNumbers =
      textures.size() > 1 || (!textures.empty() && std::any_of(parts.begin(), parts.end(),
                                                     [this](const Part& part) { return this->numberOf(part) < 0; }));
    for (const Part& part : parts)
    {
      this->part(part);
    }
  }

  std::string text(const std::vector<std::string>& pictures) const
  {
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    for (std::size_t i = 0; i < pictures.size(); ++i)
    {
      const std::string wrap = wrapOf(*this->Textures[i]);
      text += "comment TextureFile " + pictures[i] + '\n' + (wrap.empty() ? "" : "comment TextureWrap " + wrap + '\n');
    }
    text += "element vertex " + std::to_string(this->Numbers.size()) +
            "\nproperty double x\nproperty double y\nproperty double z"
            "\nproperty float nx\nproperty float ny\nproperty float nz";
    text += this->hasUvs() ? "\nproperty double s\nproperty double t" : "";
    text += "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face " +
            std::to_string(this->TheInstance.model->triangles.size()) + "\nproperty list uchar int vertex_indices";
    text += this->HasNumbers ? "\nproperty int texnumber" : "";
    return text + "\nend_header\n" + this->Vertices + this->Triangles;
  }

private:
  bool hasUvs() const { return !this->TheInstance.model->uvs.empty(); }
  const Material& materialOf(const Part& part) const
  {
    return (*this->TheInstance.materials)[std::size_t(part.material)];
  }
  /// Of a part's picture; -1 for none.
  std::int32_t numberOf(const Part& part) const
  {
    const Texture* const texture = textureOf(*this->TheInstance.model, this->materialOf(part));
    const auto found = std::find(this->Textures.begin(), this->Textures.end(), texture);
    return found == this->Textures.end() ? -1 : int(found - this->Textures.begin());
  }

  void part(const Part& part)
  {
    const Model& model = *this->TheInstance.model;
    const Material& material = this->materialOf(part);
    const std::int32_t texture = this->numberOf(part);
    for (std::uint32_t i = 0; i < part.triangles; ++i)
    {
      this->Triangles += '\3';
      for (const std::uint32_t vertex : model.triangles[part.firstTriangle + i])
      {
        const std::int32_t number = this->vertex(vertex, colorOf(model, material, vertex));
        append(this->Triangles, &number, 1);
      }
      if (this->HasNumbers)
      {
        append(this->Triangles, &texture, 1);
      }
    }
  }

  std::int32_t vertex(std::uint32_t vertex, const Color& color)
  {
    const auto [place, isNew] = this->Numbers.emplace(std::pair(vertex, color), int(this->Numbers.size()));
    if (isNew)
    {
      const Geometry& geometry = *this->TheInstance.geometry;
      append(this->Vertices, geometry.positions[vertex].data(), 3);
      append(this->Vertices, geometry.normals[vertex].data(), 3);
      if (this->hasUvs())
      {
        append(this->Vertices, this->TheInstance.model->uvs[vertex].data(), 2);
      }
      append(this->Vertices, color.data(), color.size());
    }
    return place->second;
  }

  const Instance& TheInstance;
  const std::vector<const Texture*>& Textures;
  bool HasNumbers = false; ///< faces say which picture they have
  std::map<std::pair<std::uint32_t, Color>, std::int32_t> Numbers;
  std::string Vertices;
  std::string Triangles;
};

/// A PNG of pixels that are in no file of their own.
DatasetFile writePixels(const std::string& folder, const std::string& name, const Image& image)
{
  LayerSpec spec;
  spec.name = "picture";
  spec.meaning = Meaning::Picture;
  spec.channels = image.hasAlpha ? 4 : 3;
  const auto writer = makeLayerWriter("png", FilePlace(folder, name), spec, image.width, image.height);
  const auto channels = std::size_t(spec.channels);
  Rows rows(PixelType::UInt8, spec.channels, image.width, 0, image.height);
  std::byte* const target = rows.data();
  for (std::size_t i = 0; i < image.rgba.size() / 4; ++i)
  {
    std::memcpy(target + channels * i, &image.rgba[4 * i], channels);
  }
  writer->write(rows);
  const FileRecord record = writer->finish();
  return { name, record.bytes, record.sha256, {}, {}, -1 };
}
} // namespace

WrittenModels::WrittenModels(const Stage& stage, const std::vector<std::string>& geometry)
  : State(stage.at(stage.description().firstFrame()))
{
  for (std::size_t i = 0; i < geometry.size(); ++i)
  {
    const std::string name = nameOf(geometry[i]);
    if (this->Files.count(name) == 0)
    {
      this->Files[name] = this->fileOf(i, name.substr(0, name.size() - std::string(".ply").size()));
    }
  }
}

std::string WrittenModels::nameOf(const std::string& geometry)
{
  return "models/" + geometry.substr(0, nameDigits) + ".ply";
}

WrittenModels::File WrittenModels::fileOf(std::size_t object, const std::string& stem) const
{
  const Instance& instance = this->State->instances[object];
  File file;
  file.object = object;
  for (const Part& part : instance.model->parts)
  {
    const Texture* const texture = textureOf(*instance.model, (*instance.materials)[std::size_t(part.material)]);
    if (texture != nullptr && file.pictures.count(texture) == 0)
    {
      const std::string extension = instance.model->holds(*texture) ? "png" : extensionOf(texture->path);
      file.pictures[texture] = stem + '_' + std::to_string(file.order.size()) + '.' + extension;
      file.order.push_back(texture);
    }
  }
  return file;
}

std::vector<std::string> WrittenModels::names() const
{
  std::vector<std::string> names;
  for (const auto& [name, file] : this->Files)
  {
    names.push_back(name);
    for (const Texture* texture : file.order)
    {
      names.push_back(file.pictures.at(texture));
    }
  }
  return names;
}

std::string WrittenModels::ply(const File& file) const
{
  std::vector<std::string> pictures;
  for (const Texture* texture : file.order)
  {
    pictures.push_back(std::filesystem::path(file.pictures.at(texture)).filename().string());
  }
  return PlyBody(this->State->instances[file.object], file.order).text(pictures);
}

void WrittenModels::write(const std::string& folder, RunFiles& run) const
{
  const auto writeOne = [&](const std::string& name, const auto& written)
  {
    if (!run.keep({ name }, {}))
    {
      Folder(folder).makeParents(name);
      run.plan({ name });
      run.add(written());
    }
  };
  for (const auto& [name, file] : this->Files)
  {
    const File& one = file;
    for (const Texture* texture : one.order)
    {
      const std::string& picture = one.pictures.at(texture);
      const bool isHeld = this->State->instances[one.object].model->holds(*texture);
      writeOne(picture,
        [&]
        {
          return isHeld ? writePixels(folder, picture, *texture->image)
                        : writeDocument(folder, picture, readFile(texture->path));
        });
    }
    const std::string& own = name;
    writeOne(own, [&] { return writeDocument(folder, own, this->ply(one)); });
  }
}

} // namespace dgtk
