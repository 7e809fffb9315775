// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkActorMaterial.h"

#include "dgtkPortableMath.h"
#include "dgtkSurfaceMaterial.h"
#include "dgtkSurfacePieces.h"

#include <Eigen/Geometry>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace dgtk
{

namespace
{
Eigen::Vector3d vectorOf(const double* from) { return { from[0], from[1], from[2] }; }

/// Light that a surface of VTK's physically based kind has is linear; ours is display-referred.
Eigen::Vector3d displayed(const Eigen::Vector3d& linear)
{
  return linear.unaryExpr([](double v) { return portable::srgbFromLinear(v); });
}

/// What surfaces have without regard to how they are lit.
struct PieceColors
{
  Eigen::Vector3d ambient;
  Eigen::Vector3d diffuse;
};

PieceColors colorsOf(vtkProperty& property, const SurfacePiece& piece)
{
  const bool mapped = piece.colors || piece.colorMapAt || (!piece.glyphs.empty() && piece.glyphs.front().color);
  if (mapped)
  {
    return { Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones() };
  }
  if (piece.blockColor)
  {
    return { *piece.blockColor, *piece.blockColor };
  }
  return { vectorOf(property.GetAmbientColor()), vectorOf(property.GetDiffuseColor()) };
}

void refuseTexture(vtkTexture& texture, const Image& image, Unsupported& unsupported)
{
  if (texture.GetRepeat() == 0 && texture.GetWrap() == vtkTexture::ClampToBorder)
  {
    unsupported.add("a texture that has a border around itself");
  }
  if (image.hasAlpha && texture.GetPremultipliedAlpha())
  {
    unsupported.add("a texture whose colours are multiplied by its alpha");
  }
}

int addTexture(vtkTexture& texture, Model& model, Unsupported& unsupported)
{
  texture.Update();
  vtkImageData* const input = texture.GetInput();
  std::shared_ptr<const Image> image;
  if (input != nullptr && input->GetPointData()->GetScalars() != nullptr)
  {
    vtkDataArray* const scalars = input->GetPointData()->GetScalars();
    const bool direct =
      texture.GetColorMode() == VTK_COLOR_MODE_DIRECT_SCALARS ||
      (texture.GetColorMode() == VTK_COLOR_MODE_DEFAULT && scalars->GetDataType() == VTK_UNSIGNED_CHAR);
    vtkSmartPointer<vtkImageData> mapped = input;
    if (!direct)
    {
      mapped = vtkSmartPointer<vtkImageData>::New();
      mapped->CopyStructure(input);
      mapped->GetPointData()->SetScalars(
        texture.MapScalarsToColors(scalars) != nullptr ? texture.GetMappedScalars() : nullptr);
    }
    image = imageOf(*mapped);
  }
  if (!image)
  {
    unsupported.add("a texture that is no picture of bytes");
    return -1;
  }
  refuseTexture(texture, *image, unsupported);
  Texture made;
  made.name = "texture-" + std::to_string(model.textures.size() + 1);
  made.image = image;
  made.filter = texture.GetInterpolate() == 0 ? TextureFilter::Nearest // with and without smaller pictures
                : texture.GetMipmap()         ? TextureFilter::Smooth
                                              : TextureFilter::Linear;
  made.wrap.fill(texture.GetRepeat() != 0                          ? TextureWrap::Repeat
                 : texture.GetWrap() == vtkTexture::MirroredRepeat ? TextureWrap::Mirror
                                                                   : TextureWrap::Clamp);
  model.textures.push_back(made);
  return int(model.textures.size()) - 1;
}

/// What a triangle of a polygonal data set has to say of its tangents.
class TangentTriangle
{
public:
  TangentTriangle(vtkPolyData& data, const vtkIdType* points)
    : Of(*data.GetPointData())
    , Points(points)
  {
    Eigen::Vector3d x[3];
    Eigen::Vector2d uv[3];
    for (int i = 0; i < 3; ++i)
    {
      data.GetPoint(points[i], x[i].data());
      uv[i] = { this->Of.GetTCoords()->GetComponent(points[i], 0), this->Of.GetTCoords()->GetComponent(points[i], 1) };
    }
    const Eigen::Vector2d b = uv[1] - uv[0];
    const Eigen::Vector2d c = uv[2] - uv[0];
    const double area = b.x() * c.y() - b.y() * c.x();
    this->Flat = (x[1] - x[0]).cross(x[2] - x[0]);
    this->AlongU = (c.y() * (x[1] - x[0]) - b.y() * (x[2] - x[0])) / area;
    this->AlongV = (b.x() * (x[2] - x[0]) - c.x() * (x[1] - x[0])) / area;
  }

  /// Whether VTK's tangent and bitangent at a corner are where the texture's coordinates grow.
  bool agrees(int corner) const
  {
    constexpr double cosine = 0.999;
    const Eigen::Vector3d normal = this->vector(this->Of.GetNormals(), corner, this->Flat).normalized();
    const Eigen::Vector3d tangent = this->vector(this->Of.GetTangents(), corner, Eigen::Vector3d::Zero()).cross(normal);
    const Eigen::Vector3d expected = this->AlongU.cross(normal);
    return tangent.dot(expected) > cosine * tangent.norm() * expected.norm() && -tangent.dot(this->AlongV) > 0;
  }

private:
  Eigen::Vector3d vector(vtkDataArray* array, int corner, const Eigen::Vector3d& otherwise) const
  {
    Eigen::Vector3d v = otherwise;
    for (int c = 0; array != nullptr && c < 3; ++c)
    {
      v[c] = array->GetComponent(this->Points[corner], c);
    }
    return v;
  }

  vtkPointData& Of;
  const vtkIdType* Points;
  Eigen::Vector3d Flat;
  Eigen::Vector3d AlongU;
  Eigen::Vector3d AlongV;
};

/// Whether the tangents of nearly all corners are those of the texture's coordinates, as ours always are: VTK has them
/// from its points.
bool followTexture(vtkPolyData& data)
{
  vtkIdType corners = 0;
  vtkIdType unlike = 0;
  const auto at = vtk::TakeSmartPointer(data.GetPolys()->NewIterator());
  for (at->GoToFirstCell(); !at->IsDoneWithTraversal(); at->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    at->GetCurrentCell(count, points);
    for (int corner = 0; count >= 3 && corner < 3; ++corner)
    {
      ++corners;
      unlike += TangentTriangle(data, points).agrees(corner) ? 0 : 1;
    }
  }
  return data.GetNumberOfStrips() == 0 && unlike * 20 <= corners;
}

/// A surface of VTK's physically based kind, as its mapper has it: glTF's textures, where there are coordinates for
/// them.
class PhysicalSurface
{
public:
  PhysicalSurface(vtkProperty& property, vtkPolyData& data, Model& model, Unsupported& unsupported)
    : Property(property)
    , Data(data)
    , ToModel(model)
    , Out(unsupported)
  {
  }

  void set(Material& material)
  {
    material.physical = Material::Physical{ this->Property.GetMetallic(), this->Property.GetRoughness(), true };
    material.diffuse = displayed(material.diffuse);
    this->refuse(this->Property.GetAnisotropy() != 0, "anisotropy");
    this->refuse(this->Property.GetCoatStrength() != 0, "a coat");
    this->refuse(this->Property.GetBaseIOR() != usualIndex, "another index of refraction than 1.5");
    this->refuse(vectorOf(this->Property.GetEdgeTint()) != Eigen::Vector3d::Ones(), "an edge tint");
    if (this->Data.GetPointData()->GetTCoords() != nullptr)
    {
      for (const auto& [kind, texture] : this->Property.GetAllTextures())
      {
        this->add(kind, *texture, material);
      }
    }
    this->darken(material);
  }

private:
  static constexpr double usualIndex = 1.5;

  void refuse(bool there, const std::string& what)
  {
    if (there)
    {
      this->Out.add(what + " of its physically based property");
    }
  }

  void add(const std::string& kind, vtkTexture& texture, Material& material)
  {
    const bool known = kind == "albedoTex" || kind == "materialTex" || kind == "emissiveTex" || kind == "normalTex";
    if (kind == "normalTex" && this->Data.GetPointData()->GetTangents() == nullptr)
    {
      return; // as in VTK
    }
    this->refuse(!known, "the texture " + kind);
    this->refuse(known && texture.GetTransform() != nullptr, "a transform of the texture " + kind);
    const int index = known ? addTexture(texture, this->ToModel, this->Out) : -1;
    if (index < 0)
    {
      return;
    }
    if (kind == "albedoTex")
    {
      material.texture = index;
      material.cutOut = this->ToModel.textures[std::size_t(index)].image->hasAlpha;
      material.opacity = 1; // the picture has its own
    }
    else if (kind == "normalTex")
    {
      material.normalMap = index;
      material.normalScale = this->Property.GetNormalScale();
      this->refuse(!followTexture(this->Data), "tangents that are not those of its texture coordinates");
    }
    else if (kind == "materialTex")
    {
      material.metallicRoughnessMap = index;
      this->refuse(
        this->Property.GetOcclusionStrength() != 0 && this->darkens(index), "occlusion in the texture materialTex");
    }
    else
    {
      material.emissionMap = index;
      material.emission.setOnes();
      this->refuse(vectorOf(this->Property.GetEmissiveFactor()) != Eigen::Vector3d::Ones(), "an emissive factor");
    }
  }

  /// Occlusion of VTK takes of all light, ours of that from everywhere.
  bool darkens(int index) const
  {
    const std::vector<std::uint8_t>& rgba = this->ToModel.textures[std::size_t(index)].image->rgba;
    for (std::size_t i = 0; i < rgba.size(); i += 4)
    {
      if (rgba[i] < 255)
      {
        return true;
      }
    }
    return false;
  }

  /// VTK has light from everywhere with an environment alone: none of ours is left.
  void darken(Material& material)
  {
    auto black = std::make_shared<Image>();
    black->width = 1;
    black->height = 1;
    black->rgba = { 0, 0, 0, 255 };
    Texture texture;
    texture.name = "texture-" + std::to_string(this->ToModel.textures.size() + 1);
    texture.image = black;
    texture.filter = TextureFilter::Nearest;
    this->ToModel.textures.push_back(texture);
    material.occlusionMap = int(this->ToModel.textures.size()) - 1;
  }

  vtkProperty& Property;
  vtkPolyData& Data;
  Model& ToModel;
  Unsupported& Out;
};

/// A picture of sRGB as OpenGL's textures of that kind give it: without its curve.
std::shared_ptr<const Image> linearised(const Image& image)
{
  auto made = std::make_shared<Image>(image);
  for (std::size_t i = 0; i < made->rgba.size(); ++i)
  {
    if (i % 4 != 3)
    {
      made->rgba[i] = std::uint8_t(std::lround(255 * portable::linearFromSrgb(made->rgba[i] / 255.0)));
    }
  }
  return made;
}

std::uint8_t byteAt(vtkDataArray& scalars, vtkIdType tuple, int component)
{
  return std::uint8_t(std::clamp(scalars.GetComponent(tuple, component), 0.0, 255.0));
}
} // namespace

bool isPhysical(vtkActor& actor, bool lit)
{
  return lit && actor.GetProperty()->GetLighting() && actor.GetProperty()->GetInterpolation() == VTK_PBR;
}

std::string changeOfCoordinates(vtkActor& actor)
{
  auto* const mapper = vtkPolyDataMapper::SafeDownCast(actor.GetMapper());
  vtkInformation* const keys = actor.GetPropertyKeys();
  return mapper != nullptr && (mapper->GetSeamlessU() || mapper->GetSeamlessV()) ? "seamless texture coordinates"
         : keys != nullptr && keys->Has(vtkProp::GeneralTextureTransform()) != 0
           ? "a transform of texture coordinates among its property keys"
           : "";
}

void toDisplay(std::array<std::uint8_t, 4>& color)
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    color[c] = std::uint8_t(std::lround(255 * portable::srgbFromLinear(color[c] / 255.0)));
  }
}

void toDisplay(Image& picture)
{
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
  {
    std::array<std::uint8_t, 4> texel{ picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2], 255 };
    toDisplay(texel);
    std::copy_n(texel.begin(), 3, picture.rgba.begin() + std::ptrdiff_t(i));
  }
}

std::shared_ptr<const Image> imageOf(vtkImageData& data)
{
  vtkDataArray* const scalars = data.GetPointData()->GetScalars();
  const int* const sides = data.GetDimensions();
  if (scalars == nullptr || scalars->GetDataType() != VTK_UNSIGNED_CHAR || *std::min_element(sides, sides + 3) != 1)
  {
    return nullptr;
  }
  // VTK leaves out sides of 1, the first one first.
  const int size[2] = { sides[sides[0] == 1 ? 1 : 0], sides[sides[0] == 1 || sides[1] == 1 ? 2 : 1] };
  const int components = scalars->GetNumberOfComponents();
  const int step = components >= 3 ? 1 : 0; // grey is R, G and B
  auto image = std::make_shared<Image>();
  image->width = size[0];
  image->height = size[1];
  image->rgba.resize(std::size_t(size[0]) * std::size_t(size[1]) * 4);
  std::uint8_t* to = image->rgba.data();
  for (int y = size[1] - 1; y >= 0; --y)
  {
    for (int x = 0; x < size[0]; ++x, to += 4)
    {
      const vtkIdType at = vtkIdType(y) * size[0] + x;
      for (int c = 0; c < 3; ++c)
      {
        to[c] = byteAt(*scalars, at, c * step);
      }
      const bool alpha = components == 2 || components == 4;
      to[3] = alpha ? byteAt(*scalars, at, components - 1) : 255;
      image->hasAlpha = image->hasAlpha || to[3] < 255;
    }
  }
  return image;
}

Material actorMaterial(
  vtkActor& actor, const SurfacePiece& piece, bool lit, const std::string& name, Model& model, Unsupported& unsupported)
{
  vtkProperty& property = *actor.GetProperty();
  const PieceColors colors = colorsOf(property, piece);
  const auto refuse = [&](bool there, const std::string& what)
  {
    if (there)
    {
      unsupported.add(what);
    }
  };
  Material material;
  material.name = name;
  material.opacity = piece.blockOpacity.value_or(property.GetOpacity());
  const Eigen::Vector3d ambient = property.GetAmbient() * colors.ambient;
  const Eigen::Vector3d diffuse = property.GetDiffuse() * colors.diffuse;
  if (lit && property.GetLighting())
  {
    material.ambient = ambient / worldAmbient;
    material.diffuse = diffuse;
    material.specular = property.GetSpecular() * vectorOf(property.GetSpecularColor());
    material.shininess = property.GetSpecularPower();
    if (isPhysical(actor, lit))
    {
      PhysicalSurface(property, *piece.data, model, unsupported).set(material);
    }
  }
  else
  {
    material.ambient = (ambient + diffuse) / worldAmbient;
    material.diffuse.setZero();
  }
  // VTK draws what has no coordinates of the texture without it.
  const bool hasCoordinates = piece.data->GetPointData()->GetTCoords() != nullptr;
  if (vtkTexture* const texture = actor.GetTexture(); texture != nullptr && hasCoordinates && !material.physical)
  {
    if (material.texture = addTexture(*texture, model, unsupported); material.texture >= 0)
    {
      Texture& made = model.textures[std::size_t(material.texture)];
      material.cutOut = made.image->hasAlpha;
      made.image = texture->GetUseSRGBColorSpace() ? linearised(*made.image) : made.image;
    }
  }
  for (const auto& [kind, texture] : property.GetAllTextures())
  {
    static const std::set<std::string> ofPhysical{ "albedoTex", "materialTex", "normalTex", "emissiveTex",
      "anisotropyTex", "coatNormalTex" }; // which VTK leaves out of other surfaces
    refuse(
      hasCoordinates && !material.physical && ofPhysical.count(kind) == 0, "the texture " + kind + " of its property");
  }
  refuse(actor.GetTexture() != nullptr && !material.physical && piece.colorMapAt != nullptr,
    "a texture beside scalars that are interpolated before they are mapped");
  const std::string change = changeOfCoordinates(actor);
  refuse(!change.empty() &&
           (material.texture >= 0 || (material.physical && hasCoordinates && !property.GetAllTextures().empty())),
    change);
  refuse(actor.GetForceOpaque() && material.opacity < 1, "an opacity below 1 of what is forced to be opaque");
  refuse(actor.GetShaderProperty()->GetNumberOfShaderReplacements() > 0, "replaced shaders");
  refuse(property.GetEdgeVisibility() != 0, "visible edges");
  refuse(actor.GetBackfaceProperty() != nullptr, "a property of its back faces");
  return material;
}

} // namespace dgtk
