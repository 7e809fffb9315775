// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelBuilder.h"

#include "dgtkError.h"
#include "dgtkModelObject.h"
#include "dgtkPictureProcess.h"
#include "dgtkTextLines.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int mostMaterials = 65536;
/// Added to the material of surfaces without texture coordinates until it is known whether others have some.
constexpr int unplaced = mostMaterials;
constexpr std::size_t mostTextures = 4096;
/// Corners from which on scratch memory is given back after use.
constexpr std::size_t largeSurface = 10000;
constexpr std::uint32_t none = 0xffffffffu;

double clamped(double value, double low, double high, double fallback)
{
  return std::isnan(value) ? fallback : std::min(std::max(value, low), high);
}

Eigen::Vector3d clampedColor(const Eigen::Vector3d& color, double high = 1)
{
  return { clamped(color[0], 0, high, 0), clamped(color[1], 0, high, 0), clamped(color[2], 0, high, 0) };
}

/// Names are printed as JSON and written into manifests: valid UTF-8 whatever the file has.
void makeTextsValid(Model& model)
{
  const auto fix = [](std::string& text) { text = validUtf8(text); };
  for (Part& part : model.parts)
  {
    fix(part.name);
  }
  for (Material& material : model.materials)
  {
    fix(material.name);
  }
  for (Animation& animation : model.animations)
  {
    fix(animation.name);
  }
}

std::string counted(std::size_t count, const char* what, const char* whats)
{
  return std::to_string(count) + ' ' + (count == 1 ? what : whats);
}
} // namespace

ModelBuilder::ModelBuilder(
  const std::string& path, const std::string& format, std::size_t fileBytes, const ReadOptions& options)
  : Rest(std::make_shared<Geometry>())
  , WantsPictures(options.decodeTextures)
  , MemoryLimit((std::uint64_t(48) << 20) + std::uint64_t(8) * fileBytes)
  , WorkLimit(20'000'000 + std::uint64_t(20) * fileBytes)
{
  this->Contents.model = std::make_shared<Model>();
  this->model().format = format;
  this->model().path = path;
}

ModelBuilder::~ModelBuilder() = default;

void ModelBuilder::warn(const std::string& text)
{
  if (this->Warnings < mostModelWarnings)
  {
    this->Contents.notes.push_back({ text, ModelNote::none });
    ++this->Warnings;
  }
  else
  {
    ++this->Contents.moreNotes;
  }
}

void ModelBuilder::keep(std::vector<ModelDependency> dependencies, std::uint64_t fromBytes)
{
  this->Contents.dependencies = std::move(dependencies);
  this->Contents.keptFrom = fromBytes;
}

int ModelBuilder::addMaterial(const Material& material, const MaterialAlpha& alpha)
{
  std::vector<Material>& materials = this->model().materials;
  if (materials.size() >= std::size_t(mostMaterials))
  {
    throw InputError(this->model().path, "has too many materials", "at most " + std::to_string(mostMaterials));
  }
  materials.emplace_back();
  this->Contents.alpha.push_back(alpha);
  this->setMaterial(static_cast<int>(materials.size()) - 1, material);
  return static_cast<int>(materials.size()) - 1;
}

void ModelBuilder::setMaterial(int index, const Material& material)
{
  Material& m = this->model().materials[static_cast<std::size_t>(index)];
  m = material;
  m.ambient = clampedColor(m.ambient);
  m.diffuse = clampedColor(m.diffuse);
  m.specular = clampedColor(m.specular);
  m.emission = clampedColor(m.emission, m.physical ? 1000 : 1);
  m.shininess = clamped(m.shininess, 0, 128, 0);
  m.opacity = clamped(m.opacity, 0, 1, 1);
  if (m.physical)
  {
    m.physical->metallic = clamped(m.physical->metallic, 0, 1, 0);
    m.physical->roughness = clamped(m.physical->roughness, 0, 1, 1);
  }
  m.normalScale = clamped(m.normalScale, -1000, 1000, 1);
  m.occlusionStrength = clamped(m.occlusionStrength, 0, 1, 1);
  m.texture = m.texture < static_cast<int>(this->Contents.pictures.size()) ? m.texture : -1;
}

int ModelBuilder::addTexture(
  const std::string& name, const std::string& alternative, const std::string& unescaped, const TextureWraps& wrap)
{
  if (name.empty())
  {
    return -1;
  }
  std::vector<ModelPicture>& pictures = this->Contents.pictures;
  auto& named = this->Pictures[isInFolder(alternative, name) ? alternative : name];
  const bool isNamed = !named.empty();
  const auto [known, isNew] = named.try_emplace(wrap, static_cast<int>(pictures.size()));
  if (isNew && pictures.size() >= mostTextures)
  {
    known->second = -1;
  }
  else if (isNew)
  {
    if (!isNamed) // what is to be said of a picture is said once
    {
      this->Contents.notes.push_back({ {}, known->second });
    }
    pictures.push_back({ name, alternative, unescaped, {}, 0, 0, {}, ModelPicture::own, wrap });
    if (this->WantsPictures)
    {
      picture::prepare();
    }
  }
  if (known->second < 0)
  {
    this->warn("texture " + quoted(name) + " left out: more than " + std::to_string(mostTextures) + " textures");
  }
  return known->second;
}

int ModelBuilder::addEmbedded(ModelPicture picture)
{
  this->Contents.pictures.push_back(std::move(picture));
  return static_cast<int>(this->Contents.pictures.size()) - 1;
}

int ModelBuilder::withTexture(int material, int texture)
{
  const std::size_t index = static_cast<std::size_t>(material);
  if (texture < 0 || index >= this->materials())
  {
    return material;
  }
  const auto known = this->Textured.find({ material, texture });
  if (known != this->Textured.end())
  {
    return known->second;
  }
  Material textured = this->model().materials[index];
  textured.texture = texture;
  const int made = this->addMaterial(textured);
  this->Textured[{ material, texture }] = made;
  return made;
}

int ModelBuilder::defaultMaterial()
{
  if (this->DefaultMaterial < 0)
  {
    this->DefaultMaterial = this->addMaterial({});
  }
  return this->DefaultMaterial;
}

void ModelBuilder::beginObject(const std::string& name)
{
  this->Current = std::make_unique<ModelObject>();
  this->Current->name = name;
  this->Current->firstVertex = static_cast<std::uint32_t>(this->SourceVertices);
}

void ModelBuilder::reserve(std::size_t vertices, std::size_t surfaces, std::size_t corners)
{
  this->Current->positions.reserve(vertices);
  this->Current->surfaces.reserve(surfaces);
  this->Current->corners.reserve(corners);
}

std::uint32_t ModelBuilder::addVertex(const Eigen::Vector3d& position)
{
  if (this->SourceVertices >= none)
  {
    throw InputError(this->model().path, "has too many vertices", "fewer than 4294967295");
  }
  this->Current->positions.push_back(position);
  return static_cast<std::uint32_t>(this->SourceVertices++);
}

std::int32_t ModelBuilder::addNormal(const Eigen::Vector3d& normal)
{
  const double length = normal.stableNorm();
  if (!(length > 0 && std::isfinite(length)) || this->Current->normals.size() >= 0x7fffffff)
  {
    return -1;
  }
  this->Current->normals.push_back((normal / length).cast<float>());
  return static_cast<std::int32_t>(this->Current->normals.size()) - 1;
}

bool ModelBuilder::usable(const Corner* corners, std::size_t count)
{
  const ModelObject& object = *this->Current;
  if (count < 3)
  {
    ++this->SmallSurfaces;
    return false;
  }
  bool finite = true;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t index = corners[i].vertex - object.firstVertex;
    if (corners[i].vertex < object.firstVertex || index >= object.positions.size() ||
        corners[i].normal >= static_cast<std::int32_t>(object.normals.size()))
    {
      ++this->BadIndexSurfaces;
      return false;
    }
    finite = finite && isDrawable(object.positions[index]);
  }
  this->NotFiniteSurfaces += finite ? 0 : 1;
  return finite;
}

/// Whether one has a texture coordinate.
bool ModelBuilder::addCorners(const Corner* corners, std::size_t count)
{
  ModelObject& object = *this->Current;
  object.polygon.clear();
  object.polygon.reserve(count);
  makeRoom(object.corners, count);
  bool isPlaced = false;
  for (std::size_t i = 0; i < count; ++i)
  {
    Corner corner = corners[i];
    isPlaced = isPlaced || std::isfinite(corner.u) || std::isfinite(corner.v);
    corner.u = std::isfinite(corner.u) ? corner.u : 0;
    corner.v = std::isfinite(corner.v) ? corner.v : 0;
    this->HasUvs = this->HasUvs || corner.u != 0 || corner.v != 0;
    object.corners.push_back(corner);
    object.polygon.push_back(object.positions[object.local(corner)]);
  }
  return isPlaced;
}

bool ModelBuilder::addSurface(const Corner* corners, std::size_t count, const SurfaceStyle& style)
{
  if (!this->usable(corners, count))
  {
    return false;
  }
  ModelObject& object = *this->Current;
  const auto first = static_cast<std::uint32_t>(object.corners.size());
  if (object.corners.size() + count >= none)
  {
    throw InputError(this->model().path, "has too many surfaces in one object");
  }
  const bool isPlaced = this->addCorners(corners, count);
  object.cut.reserve(count - 2);
  this->GaveUpShape = !triangulate(object.polygon, object.cut, this->Work, this->WorkLimit) || this->GaveUpShape;
  ModelObject::Surface surface{ first, static_cast<std::uint32_t>(count),
    static_cast<std::uint32_t>(object.triangles.size()), static_cast<std::uint32_t>(object.cut.size()), style,
    polygonNormal(object.polygon), 0, isPlaced };
  surface.area = surface.normal.stableNorm();
  surface.normal = surface.area > 0 ? Eigen::Vector3d(surface.normal / surface.area) : Eigen::Vector3d(0, 0, 0);
  if (style.material < 0 || static_cast<std::size_t>(style.material) >= this->materials())
  {
    surface.style.material = this->defaultMaterial();
  }
  makeRoom(object.triangles, object.cut.size());
  for (const std::array<std::uint32_t, 3>& t : object.cut)
  {
    object.triangles.push_back({ first + t[0], first + t[1], first + t[2] });
  }
  if (count > largeSurface)
  {
    std::vector<Eigen::Vector3d>().swap(object.polygon);
    std::vector<std::array<std::uint32_t, 3>>().swap(object.cut);
  }
  if (style.twoSided)
  {
    this->model().materials[static_cast<std::size_t>(surface.style.material)].twoSided = true;
    this->model().twoSidedTriangles += surface.triangles;
  }
  surface.style.material += !isPlaced && this->hasPictures(surface.style.material) ? unplaced : 0;
  object.surfaces.push_back(surface);
  return true;
}

void ModelBuilder::growBounds(const Eigen::Vector3d& position)
{
  Model& model = this->model();
  if (model.boundsMin.x() > model.boundsMax.x())
  {
    model.boundsMin = model.boundsMax = position;
  }
  model.boundsMin = model.boundsMin.cwiseMin(position);
  model.boundsMax = model.boundsMax.cwiseMax(position);
}

void ModelBuilder::addLine(std::uint32_t a, std::uint32_t b)
{
  const Corner ends[3] = { { a, -1, 0, 0 }, { b, -1, 0, 0 }, { b, -1, 0, 0 } };
  if (this->usable(ends, 3))
  {
    ++this->model().lines;
    this->growBounds(this->Current->positions[this->Current->local(ends[0])]);
    this->growBounds(this->Current->positions[this->Current->local(ends[1])]);
  }
}

void ModelBuilder::setObjectName(const std::string& name) { this->Current->name = name; }

void ModelBuilder::setCrease(double degrees) { this->Current->crease = clamped(degrees, 0, 180, 61); }

void ModelBuilder::endObject()
{
  if (!this->Current->surfaces.empty())
  {
    this->addParts(this->addSplitVertices(this->smooth()));
  }
  this->Current.reset();
}

bool ModelBuilder::hasPictures(int material) const
{
  const auto index = static_cast<std::size_t>(material);
  const Material& m = this->Contents.model->materials[index];
  return this->Contents.alpha[index].mask >= 0 || std::any_of(materialTextures.begin(), materialTextures.end(),
                                                    [&m](const auto texture) { return m.*texture >= 0; });
}

/// Index of a copy that looks as the material does where there are no texture coordinates.
int ModelBuilder::withoutPictures(int material)
{
  const auto index = static_cast<std::size_t>(material);
  Material bare = this->model().materials[index];
  bare.isBare = true;
  bare.isDark = bare.emissionMap >= 0;
  if (bare.isDark)
  {
    bare.emission.setZero(); // where it glows is not known
  }
  for (const auto texture : materialTextures)
  {
    bare.*texture = -1;
  }
  MaterialAlpha alpha = this->Contents.alpha[index];
  alpha.mask = MaterialAlpha::none;
  this->model().materials.push_back(bare); // however many there are
  this->Contents.alpha.push_back(alpha);
  return static_cast<int>(this->materials()) - 1;
}

void ModelBuilder::settleUnplaced()
{
  std::map<int, int> bare;
  std::size_t triangles = 0;
  for (Part& part : this->model().parts)
  {
    if (part.material >= unplaced)
    {
      part.material -= unplaced;
      triangles += part.triangles;
      const auto [known, isNew] = bare.try_emplace(part.material, part.material);
      known->second = isNew && this->HasUvs ? this->withoutPictures(part.material) : known->second;
      part.material = known->second;
    }
  }
  if (triangles > 0)
  {
    this->warn(counted(triangles, "triangle has", "triangles have") +
               " pictures but no texture coordinates: drawn without pictures");
  }
}

ModelContents ModelBuilder::finish()
{
  Model& model = this->model();
  this->Contents.notes.push_back({ {}, ModelNote::ofDecoding });
  model.sourceVertices = this->SourceVertices;
  if (this->HasUvs)
  {
    model.uvs.resize(this->Rest->positions.size(), Eigen::Vector2d(0, 0));
    model.unplaced.resize(model.unplaced.empty() ? 0 : model.triangles.size());
  }
  else
  {
    std::vector<std::uint8_t>().swap(model.unplaced);
  }
  this->settleUnplaced();
  model.rest = this->Rest;
  if (model.deformation)
  {
    groupNormals(model);
    model.rest = geometryAt(model, 0, model.animations.empty() ? 0 : model.animations.front().first);
  }
  const auto report = [this](std::size_t count, const char* why)
  {
    if (count > 0)
    {
      this->warn(counted(count, "surface", "surfaces") + " left out: " + why);
    }
  };
  report(this->SmallSurfaces, "fewer than three corners");
  report(this->BadIndexSurfaces, "a vertex that does not exist");
  report(this->NotFiniteSurfaces, "a coordinate that is not a finite number");
  if (this->GaveUpFlat)
  {
    this->warn("flat surfaces are drawn smooth: there are too many for the memory allowed for a file of this size");
  }
  if (this->GaveUpShape)
  {
    this->warn("some surfaces are triangulated or smoothed in a simple way: their shape would take too long to settle");
  }
  makeTextsValid(model);
  return std::move(this->Contents);
}

void setSourceOf(Model& model, std::vector<std::uint32_t> sourceOf)
{
  const auto isOwn = [vertex = 0u](std::uint32_t source) mutable { return source == vertex++; };
  if (!std::all_of(sourceOf.begin(), sourceOf.end(), isOwn))
  {
    model.sourceOf = std::move(sourceOf);
  }
}

} // namespace dgtk
