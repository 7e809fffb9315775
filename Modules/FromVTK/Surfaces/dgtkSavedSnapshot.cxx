// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSavedSnapshot.h"

#include "dgtkColorMap.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkGlyphCopies.h"
#include "dgtkLayerWriter.h"
#include "dgtkRendererLights.h"
#include "dgtkSurfaceMaterial.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>

namespace dgtk
{

namespace
{
constexpr const char* modelFolder = "models";
constexpr double leastOpacity = 1e-6; ///< of files: readers have an opacity of 0 for a mistake, and what has it opaque

std::string joinedNumbers(const double* numbers, std::size_t count)
{
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
  {
    text += ' ' + shortest(numbers[i]);
  }
  return text;
}

std::string rowOf(const char* keyword, const Eigen::Vector3d& v) { return keyword + joinedNumbers(v.data(), 3) + '\n'; }

void writePicture(const Image& image, const std::string& path)
{
  const LayerSpec spec{ "texture", PixelType::UInt8, 4, "", "", "", "", Meaning::Picture };
  const auto writer = makeLayerWriter("png", FilePlace(path), spec, image.width, image.height);
  Rows rows(PixelType::UInt8, 4, image.width, 0, image.height);
  std::memcpy(rows.data(), image.rgba.data(), rows.bytes());
  writer->write(rows);
  writer->finish();
}

/// Texels as blocks of so many, for pictures whose nearest texel counts: files are filtered, which then shows at the
/// blocks' borders only.
Image inBlocks(const Image& from, int across, int down)
{
  Image made = from;
  made.width = across * from.width;
  made.height = down * from.height;
  made.rgba.clear();
  made.rgba.reserve(4 * std::size_t(made.width) * std::size_t(made.height));
  for (int y = 0; y < made.height; ++y)
  {
    const std::ptrdiff_t row = std::ptrdiff_t(y / down) * from.width;
    for (int x = 0; x < made.width; ++x)
    {
      const auto texel = from.rgba.begin() + 4 * (row + x / across);
      made.rgba.insert(made.rgba.end(), texel, texel + 4);
    }
  }
  return made;
}

/// Blocks that make a side at most that long.
int blocksOf(int side, int most) { return std::max(1, most / side); }

/// A map of colours as a texture: filters that reduce it do not mix its rows.
Image asTexture(const Image& map)
{
  constexpr int mostWidth = 1024;
  constexpr int rowHeight = 256;
  return inBlocks(map, blocksOf(map.width, mostWidth), rowHeight);
}

Image asFile(const Texture& texture)
{
  constexpr int mostSide = 1024;
  const Image& image = *texture.image;
  return texture.filter == TextureFilter::Nearest && (image.width > 1 || image.height > 1)
           ? inBlocks(image, blocksOf(image.width, mostSide), blocksOf(image.height, mostSide))
           : image;
}

/// A place in it: in the middle of the row.
Eigen::Vector2d inTexture(const Eigen::Vector2d& place, const Image& map)
{
  const double row = std::clamp(std::floor(place.y() * map.height), 0.0, map.height - 1.0);
  return { place.x(), (row + 0.5) / map.height };
}

/// One model as OBJ with its library of materials.
class ObjFile
{
public:
  ObjFile(const Model& model, const std::string& folder, const std::string& name)
    : From(model)
    , Folder(folder)
    , Name(name)
    , MapIsTexture(model.colorMap && model.textures.empty())
  {
  }

  /// Whether texture coordinates are places in the map of colours.
  bool mapIsTexture() const { return this->MapIsTexture; }

  /// `ambientScale`: of the materials' ambient colours.
  void write(double ambientScale) const
  {
    writeFile(FilePlace(this->Folder + '/' + this->Name + ".mtl"), this->library(ambientScale));
    writeFile(FilePlace(this->Folder + '/' + this->Name + ".obj"), this->text());
    for (std::size_t i = 0; i < this->From.textures.size(); ++i)
    {
      writePicture(asFile(this->From.textures[i]), this->Folder + '/' + this->picture(i));
    }
    if (this->MapIsTexture)
    {
      writePicture(asTexture(*this->From.colorMap), this->Folder + '/' + this->picture(this->From.textures.size()));
    }
  }

private:
  std::string picture(std::size_t index) const { return this->Name + "-texture-" + std::to_string(index + 1) + ".png"; }

  std::string library(double ambientScale) const
  {
    std::string text;
    for (const Material& m : this->From.materials)
    {
      text += "newmtl " + m.name + '\n' + rowOf("Ka", ambientScale * m.ambient) + rowOf("Kd", m.diffuse) +
              rowOf("Ks", m.specular) + "Ns " + shortest(m.shininess) + "\nd " +
              shortest(std::max(m.opacity, leastOpacity)) + '\n';
      if (m.texture >= 0 || this->MapIsTexture)
      {
        const bool clamped = m.texture < 0 || this->From.textures[std::size_t(m.texture)].wrap[0] == TextureWrap::Clamp;
        text += std::string("map_Kd ") + (clamped ? "-clamp on " : "") +
                this->picture(m.texture >= 0 ? std::size_t(m.texture) : this->From.textures.size()) + '\n';
      }
    }
    return text;
  }

  std::string text() const
  {
    const Model& m = this->From;
    const Geometry& g = *m.rest;
    const std::vector<Eigen::Vector2d>& uvs = this->MapIsTexture ? m.colorMapAt : m.uvs;
    std::string text = "mtllib " + this->Name + ".mtl\no " + this->Name + '\n';
    for (std::size_t i = 0; i < g.positions.size(); ++i)
    {
      text += 'v' + joinedNumbers(g.positions[i].data(), 3) + this->color(i) + '\n';
    }
    for (const Eigen::Vector2d& uv : uvs)
    {
      const Eigen::Vector2d place = this->MapIsTexture ? inTexture(uv, *m.colorMap) : uv;
      text += "vt" + joinedNumbers(place.data(), 2) + '\n';
    }
    for (const Eigen::Vector3f& normal : g.normals)
    {
      text += rowOf("vn", normal.cast<double>());
    }
    for (const Part& part : m.parts)
    {
      const Material& material = m.materials[std::size_t(part.material)];
      const bool isDarkened = material.occlusionMap >= 0;
      text += "usemtl " + material.name + '\n';
      for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
      {
        // pictures that darken all of a surface need no coordinates in VTK, but files do
        const bool placed = !uvs.empty() && (this->MapIsTexture || m.hasUvs(t) || isDarkened);
        text += 'f';
        for (const std::uint32_t corner : m.triangles[t])
        {
          const std::string index = std::to_string(corner + 1);
          text += ' ' + index + '/' + (placed ? index : "") + '/' + index;
        }
        text += '\n';
      }
    }
    return text;
  }

  /// R, G, B and, where it is not opaque, A behind a vertex.
  std::string color(std::size_t vertex) const
  {
    if (this->From.colors.empty() && (!this->From.colorMap || this->MapIsTexture))
    {
      return {};
    }
    const auto bytes = vertexColor(this->From, vertex);
    double numbers[4];
    for (std::size_t c = 0; c < 4; ++c)
    {
      numbers[c] = bytes[c] / 255.0;
    }
    return joinedNumbers(numbers, bytes[3] < 255 ? 4 : 3);
  }

  const Model& From;
  const std::string& Folder;
  const std::string& Name;
  bool MapIsTexture;
};

/// What OBJ cannot say of the physically based materials of an actor.
std::vector<MaterialOverride> physicalMaterials(const Model& model, const std::string& name)
{
  std::vector<MaterialOverride> all;
  const auto picture = [&name](int texture) -> std::optional<std::string>
  {
    return texture >= 0 ? std::optional<std::string>(
                            std::string(modelFolder) + '/' + name + "-texture-" + std::to_string(texture + 1) + ".png")
                        : std::nullopt;
  };
  for (const Material& material : model.materials)
  {
    if (!material.physical)
    {
      continue;
    }
    MaterialOverride to;
    to.material = material.name;
    to.metallic = material.physical->metallic;
    to.roughness = material.physical->roughness;
    to.emission = material.emission;
    to.normalMap = picture(material.normalMap);
    to.metallicRoughnessMap = picture(material.metallicRoughnessMap);
    to.emissionMap = picture(material.emissionMap);
    to.occlusionMap = picture(material.occlusionMap);
    all.push_back(to);
  }
  return all;
}

/// Pictures of normals have their scale in them, which scenes do not have beside them.
Model withScaledNormals(const Model& from)
{
  constexpr double byteOfZero = 128; // as glTF's pictures are read
  constexpr double bytesOfOne = 127;
  Model model = from;
  for (Material& material : model.materials)
  {
    if (material.normalMap < 0)
    {
      continue;
    }
    Texture& texture = model.textures[std::size_t(material.normalMap)];
    auto scaled = std::make_shared<Image>(*texture.image);
    for (std::size_t i = 0; i < scaled->rgba.size(); i += 4)
    {
      std::uint8_t* const texel = &scaled->rgba[i];
      Eigen::Vector3d normal = (Eigen::Vector3d(texel[0], texel[1], texel[2]).array() - byteOfZero) / bytesOfOne;
      normal.head<2>() *= material.normalScale;
      normal.normalize();
      for (int c = 0; c < 3; ++c)
      {
        texel[c] = std::uint8_t(std::lround(byteOfZero + bytesOfOne * normal[c]));
      }
    }
    texture.image = scaled;
    material.normalScale = 1;
  }
  return model;
}

/// Whether a texture of a model is seen beyond its border where its files cannot say what is there: an OBJ's library
/// says where a border goes on, of the base texture alone.
bool isLostBeyondBorder(const Model& model)
{
  return std::any_of(model.parts.begin(), model.parts.end(),
    [&model](const Part& part)
    {
      const Material& m = model.materials[std::size_t(part.material)];
      const bool clamped = m.texture >= 0 && model.textures[std::size_t(m.texture)].wrap[0] == TextureWrap::Clamp;
      return !std::all_of(materialTextures.begin() + (clamped ? 1 : 0), materialTextures.end(),
               [&model, &m](auto texture)
               { return m.*texture < 0 || model.textures[std::size_t(m.*texture)].repeats(); }) &&
             model.reachesBeyondPictures(part);
    });
}

void refuseBorders(const FrozenView& view)
{
  for (const FrozenActor& actor : view.actors)
  {
    const bool isLost = actor.whole->copies ? std::any_of(actor.whole->copies->begin(), actor.whole->copies->end(),
                                                [](const ModelCopy& copy)
                                                { return copy.firstInPart == 0 && isLostBeyondBorder(*copy.model); })
                                            : isLostBeyondBorder(*actor.model);
    if (isLost)
    {
      throw InputError("VTK scene", actor.name + " has a texture that does not repeat, which its files cannot say",
        "texture coordinates from 0 to 1, or a texture that repeats");
    }
  }
}

/// Files hold ambient colours up to 1: the ambient light of a scene whose colours are at most that. More than the
/// renderer's own needs a light.
double ambientLight(const FrozenView& view)
{
  double most = 0;
  for (const FrozenActor& actor : view.actors)
  {
    for (const Material& material : actor.model->materials)
    {
      most = std::max(most, material.ambient.maxCoeff());
    }
  }
  return most > 1 ? std::max(1.0, most * worldAmbient) : worldAmbient;
}

void addAmbientLight(SceneDescription& scene, double more)
{
  if (scene.lights.empty())
  {
    scene.lights.push_back(headLight());
  }
  LightDescription ambient;
  ambient.name = "ambient";
  ambient.kind = LightKind::Directional;
  ambient.position = Eigen::Vector3d(0, 1, 0);
  ambient.ambient = Eigen::Vector3d(Eigen::Vector3d::Constant(more));
  ambient.diffuse = Eigen::Vector3d(0, 0, 0);
  ambient.specular = Eigen::Vector3d(0, 0, 0);
  scene.lights.push_back(ambient);
}
} // namespace

std::vector<std::string> saveSnapshot(const FrozenView& view, const std::string& path)
{
  std::vector<std::string> changes;
  refuseBorders(view);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const std::string models = (std::filesystem::path(folder) / modelFolder).string();
  makeFolders(models);
  SceneDescription scene = view.stage->description();
  scene.folder = folder;
  const double ambient = ambientLight(view);
  for (std::size_t i = 0; i < view.actors.size(); ++i)
  {
    const FrozenActor& actor = view.actors[i];
    const std::shared_ptr<const Model> model = actor.whole->copies ? writtenOut(*actor.whole) : actor.model;
    const Model written = withScaledNormals(*model);
    const ObjFile file(written, models, actor.name);
    file.write(worldAmbient / ambient);
    if (file.mapIsTexture())
    {
      changes.push_back(actor.name + ": its texture coordinates are places in its map of colours");
    }
    scene.objects[i].model = std::string(modelFolder) + '/' + actor.name + ".obj";
    scene.objects[i].materials = physicalMaterials(*model, actor.name);
  }
  if (ambient > worldAmbient)
  {
    addAmbientLight(scene, ambient - worldAmbient);
  }
  writeScene(scene, path);
  return changes;
}

} // namespace dgtk
