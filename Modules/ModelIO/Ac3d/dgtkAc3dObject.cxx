// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAc3dObject.h"

#include "dgtkError.h"

#include <algorithm>
#include <limits>

namespace dgtk
{

namespace
{
/// Low bits of a surface's flags.
enum SurfaceKind : unsigned
{
  Polygon = 0,
  ClosedLine = 1,
  OpenLine = 2,
  Strip = 4
};
} // namespace

void Ac3dObject::begin(const Affine3& root_from_parent, const std::string& texture)
{
  this->Root_from_parent = root_from_parent;
  this->Parent_from_object = Affine3();
  this->Texture = texture;
  this->Repeat = { 1, 1 };
  this->Offset = { 0, 0 };
  this->Vertices = 0;
  this->Normals.clear();
  this->Flags = 0;
  this->SurfaceMaterial = -1;
  this->SurfacesLeft = 0;
  this->Builder.beginObject("");
}

void Ac3dObject::end() { this->Builder.endObject(); }

void Ac3dObject::report()
{
  if (this->BadMaterials > 0)
  {
    this->Builder.warn(
      std::to_string(this->BadMaterials) + " surface(s) name a material that does not exist; a grey one is used");
  }
  if (this->UnknownSurfaces > 0)
  {
    this->Builder.warn(std::to_string(this->UnknownSurfaces) + " surface(s) left out: unknown type");
  }
}

void Ac3dObject::statement(const Words& words)
{
  const std::string_view key = words[0];
  if (key == "name")
  {
    this->Builder.setObjectName(words.size() > 1 ? std::string(words[1]) : std::string());
  }
  else if (key == "texture")
  {
    this->textureStatement(words);
  }
  else if (key == "texrep" || key == "texoff")
  {
    const Eigen::Vector2d value(
      this->Lines.number(words, 1, "texture placement"), this->Lines.number(words, 2, "texture placement"));
    (key == "texrep" ? this->Repeat : this->Offset) = value;
  }
  else if (key == "loc")
  {
    this->Parent_from_object.translation = this->Lines.vector(words, 1, "location");
  }
  else if (key == "rot")
  {
    for (Eigen::Index row = 0; row < 3; ++row)
    {
      this->Parent_from_object.linear.row(row) =
        this->Lines.vector(words, 1 + 3 * static_cast<std::size_t>(row), "rotation");
    }
  }
  else if (key == "crease")
  {
    this->Builder.setCrease(this->Lines.number(words, 1, "crease angle"));
  }
  else if (key == "numvert")
  {
    this->vertices(this->Lines.count(words, "vertices"));
  }
  else if (key == "numsurf")
  {
    this->SurfacesLeft = this->Lines.count(words, "surfaces");
  }
  else if (key == "SURF")
  {
    const std::optional<long long> flags = words.size() > 1 ? parseInteger(words[1]) : std::nullopt;
    if (!flags)
    {
      this->Lines.fail("bad surface", "SURF and its flags", quoted(std::string(this->Lines.line())));
    }
    this->Flags = static_cast<unsigned>(*flags);
    this->SurfaceMaterial = -1;
  }
  else if (key == "mat")
  {
    this->SurfaceMaterial = this->Lines.count(words, "the material");
  }
  else if (key == "refs")
  {
    this->refs(this->Lines.count(words, "corners"));
  }
}

/// Later lines of a texture are layers for other purposes: tiled, skids, shad.
void Ac3dObject::textureStatement(const Words& words)
{
  const std::string_view layer = words.size() > 2 ? words[2] : std::string_view("base");
  if (layer == "tiled" || layer == "skids" || layer == "shad")
  {
    return;
  }
  const std::string name = words.size() > 1 ? std::string(words[1]) : std::string();
  this->Texture = name == "empty_texture_no_mapping" ? std::string() : name;
}

void Ac3dObject::vertices(long long number)
{
  const Affine3 root_from_object = this->rootFromObject();
  // an entry has at least six characters
  const auto possible = static_cast<long long>(this->Lines.remaining() / 6) + 1;
  this->Builder.reserve(this->Vertices + static_cast<std::size_t>(std::min(number, possible)), 0, 0);
  for (long long i = 0; i < number && this->Lines.nextEntry("vertices", i, number); ++i)
  {
    const Words& words = this->Lines.words();
    const Eigen::Vector3d p = this->Lines.vector(words, 0, "vertex");
    const std::uint32_t index = this->Builder.addVertex(root_from_object * p);
    if (this->Vertices == 0)
    {
      this->FirstVertex = index;
    }
    ++this->Vertices;
    if (words.size() >= 6)
    {
      const Eigen::Vector3d n = this->Lines.vector(words, 3, "normal");
      this->Normals.resize(this->Vertices - 1, -1);
      this->Normals.push_back(n.allFinite() ? this->Builder.addNormal(turnedNormal(root_from_object.linear, n)) : -1);
    }
  }
}

Corner Ac3dObject::corner(const Words& words)
{
  const std::optional<long long> index = parseInteger(words[0]);
  if (!index)
  {
    this->Lines.fail("bad corner of a surface", "an index of a vertex", quoted(std::string(words[0])));
  }
  Corner corner;
  const bool exists = *index >= 0 && *index < static_cast<long long>(this->Vertices);
  corner.vertex =
    exists ? this->FirstVertex + static_cast<std::uint32_t>(*index) : std::numeric_limits<std::uint32_t>::max();
  if (exists && static_cast<std::size_t>(*index) < this->Normals.size())
  {
    corner.normal = this->Normals[static_cast<std::size_t>(*index)];
  }
  if (words.size() >= 3)
  {
    const Eigen::Vector2d uv(
      this->Lines.number(words, 1, "texture coordinate"), this->Lines.number(words, 2, "texture coordinate"));
    const Eigen::Vector2d placed = this->Offset + this->Repeat.cwiseProduct(uv);
    corner.u = static_cast<float>(placed[0]);
    corner.v = static_cast<float>(placed[1]);
  }
  return corner;
}

void Ac3dObject::refs(long long number)
{
  // a corner has at least two characters
  this->Corners = std::vector<Corner>();
  this->Corners.reserve(static_cast<std::size_t>(
    std::min<unsigned long long>(static_cast<unsigned long long>(number), this->Lines.remaining() / 2 + 1)));
  for (long long i = 0; i < number && this->Lines.nextEntry("corners", i, number); ++i)
  {
    this->Corners.push_back(this->corner(this->Lines.words()));
  }
  --this->SurfacesLeft;
  this->Builder.model().twoSidedSurfaces += (this->Flags & 0x20u) != 0 ? 1 : 0;
  switch (this->Flags & 0xfu)
  {
    case Polygon:
      this->Builder.addSurface(this->Corners, this->style());
      break;
    case ClosedLine:
    case OpenLine:
      this->line((this->Flags & 0xfu) == ClosedLine);
      break;
    case Strip:
      this->strip();
      break;
    default:
      ++this->UnknownSurfaces;
  }
}

SurfaceStyle Ac3dObject::style()
{
  SurfaceStyle style;
  const bool known =
    this->SurfaceMaterial >= 0 && this->SurfaceMaterial < static_cast<long long>(this->Materials.size());
  this->BadMaterials += known ? 0 : 1;
  const int base =
    known ? this->Materials[static_cast<std::size_t>(this->SurfaceMaterial)] : this->Builder.defaultMaterial();
  style.material = this->Builder.withTexture(base, this->Builder.addTexture(this->Texture));
  style.shading = (this->Flags & 0x10u) != 0 ? Shading::Crease : Shading::Flat;
  style.twoSided = (this->Flags & 0x20u) != 0;
  return style;
}

void Ac3dObject::line(bool closed)
{
  const std::vector<Corner>& c = this->Corners;
  for (std::size_t i = 1; i < c.size(); ++i)
  {
    this->Builder.addLine(c[i - 1].vertex, c[i].vertex);
  }
  if (closed && c.size() > 2)
  {
    this->Builder.addLine(c.back().vertex, c.front().vertex);
  }
}

/// Every second triangle of a strip is turned; those with a repeated vertex only steer it.
void Ac3dObject::strip()
{
  const std::vector<Corner>& c = this->Corners;
  const SurfaceStyle look = this->style();
  for (std::size_t i = 2; i < c.size(); ++i)
  {
    const Corner triangle[3] = { i % 2 == 0 ? c[i - 2] : c[i - 1], i % 2 == 0 ? c[i - 1] : c[i - 2], c[i] };
    if (triangle[0].vertex != triangle[1].vertex && triangle[1].vertex != triangle[2].vertex &&
        triangle[0].vertex != triangle[2].vertex)
    {
      this->Builder.addSurface(triangle, 3, look);
    }
  }
}

} // namespace dgtk
