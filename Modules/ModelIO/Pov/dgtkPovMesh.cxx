// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovParser.h"

#include "dgtkError.h"

#include <cmath>

namespace dgtk
{

std::uint32_t PovParser::MeshMaker::vertex(const Eigen::Vector3d& position)
{
  const std::array<double, 3> key = { position.x() + 0.0, position.y() + 0.0, position.z() + 0.0 };
  if (!position.allFinite())
  {
    this->Mesh->vertices.push_back(position);
    return static_cast<std::uint32_t>(this->Mesh->vertices.size()) - 1;
  }
  const auto [known, isNew] = this->Known.try_emplace(key, static_cast<std::uint32_t>(this->Mesh->vertices.size()));
  if (isNew)
  {
    this->Mesh->vertices.push_back(position);
  }
  return known->second;
}

std::int32_t PovParser::MeshMaker::normal(const Eigen::Vector3d& direction)
{
  this->Mesh->normals.push_back(direction.cast<float>());
  return static_cast<std::int32_t>(this->Mesh->normals.size()) - 1;
}

std::int32_t PovParser::MeshMaker::uv(const Eigen::Vector2d& uv)
{
  this->Mesh->uvs.push_back(uv.cast<float>());
  return static_cast<std::int32_t>(this->Mesh->uvs.size()) - 1;
}

std::int32_t PovParser::MeshMaker::texture(const PovTexturePointer& texture)
{
  const auto [known, isNew] =
    this->KnownTextures.try_emplace(texture, static_cast<std::int32_t>(this->Mesh->textures.size()));
  if (isNew)
  {
    this->Mesh->textures.push_back(texture);
  }
  return known->second;
}

std::shared_ptr<const PovMesh> PovParser::MeshMaker::take()
{
  this->Known.clear();
  this->KnownTextures.clear();
  auto taken = std::make_shared<PovMesh>();
  taken.swap(this->Mesh);
  return taken;
}

/// `{ corner, corner, corner ... }` after triangle or smooth_triangle.
void PovParser::triangle(bool smooth, MeshMaker& to)
{
  const Guard guard(*this);
  const char* const name = smooth ? "smooth_triangle" : "triangle";
  this->Contexts.emplace_back();
  this->Contexts.back().isMesh = true;
  this->expect('{', name);
  Eigen::Vector3d corners[3];
  Eigen::Vector3d normals[3];
  for (int i = 0; i < 3; ++i)
  {
    corners[i] = this->vector(name);
    this->accept(',');
    if (smooth)
    {
      normals[i] = this->vector(name);
      this->accept(',');
    }
  }
  PovMesh::Face face;
  Modifiers modifiers;
  while (!this->accept('}'))
  {
    const PovToken token = this->peek();
    if (token.is("uv_vectors"))
    {
      this->take();
      for (std::size_t i = 0; i < 3; ++i)
      {
        face.uv[i] = to.uv(this->vector("uv_vectors").head<2>());
        this->accept(',');
      }
    }
    else if (token.is("texture_list"))
    {
      this->failAt(token, "a triangle of three textures is not evaluated", "one texture");
    }
    else if (!this->modifier(modifiers))
    {
      this->failAt(token, std::string("cannot be understood in a ") + name, "a modifier or '}'");
    }
  }
  this->Contexts.pop_back();
  if (modifiers.invisible)
  {
    return;
  }
  const Eigen::Matrix3d turn = modifiers.transform.linear().determinant() != 0
                                 ? Eigen::Matrix3d(modifiers.transform.linear().inverse().transpose())
                                 : Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    face.vertex[i] = to.vertex(modifiers.transform * corners[i]);
    face.normal[i] = smooth ? to.normal(turn * normals[i]) : -1;
  }
  face.texture = modifiers.texture ? to.texture(modifiers.texture) : -1;
  to.add(face);
}

PovShape PovParser::mesh()
{
  const Guard guard(*this);
  this->Contexts.emplace_back();
  this->Contexts.back().isMesh = true;
  this->expect('{', "mesh");
  MeshMaker maker;
  Modifiers modifiers;
  PovShape shape(1);
  const PovToken first = this->peek();
  const auto known = first.kind == PovToken::Kind::Word ? this->Names.find(first.text) : this->Names.end();
  if (known != this->Names.end() && known->second.kind == PovValue::Kind::Shape)
  {
    this->take();
    known->second.used = true;
    shape = known->second.shape;
    this->countInstances(shape.size(), first.place);
  }
  while (!this->accept('}'))
  {
    const PovToken token = this->peek();
    if (token.is("triangle") || token.is("smooth_triangle"))
    {
      this->take();
      this->triangle(token.is("smooth_triangle"), maker);
    }
    else if (!this->modifier(modifiers))
    {
      this->failAt(token, "cannot be understood in a mesh", "triangle, smooth_triangle, a modifier or '}'");
    }
  }
  this->Contexts.pop_back();
  if (!maker.empty() || !shape[0].mesh)
  {
    shape.resize(1);
    shape[0] = {};
    shape[0].mesh = maker.take();
  }
  this->apply(shape, modifiers, true);
  return shape;
}

/// `{ COUNT, item, item, ... }`; the count must be right.
template <class Item>
void PovParser::list(const char* name, Item item)
{
  this->expect('{', name);
  const PovPlace place = this->peek().place;
  const std::uint32_t claimed = this->index(this->scalar(this->expression(), place), place);
  std::uint32_t found = 0;
  this->accept(',');
  while (!this->accept('}'))
  {
    item();
    this->accept(',');
    ++found;
  }
  if (found != claimed)
  {
    this->fail(place, std::string(name) + " has a wrong count", std::to_string(claimed), std::to_string(found));
  }
}

std::uint32_t PovParser::index(double value, const PovPlace& place)
{
  if (!(value >= 0 && value < 2147483647.0) || value != std::floor(value))
  {
    this->fail(place, "is no index or count", "a whole number, 0 or larger");
  }
  return static_cast<std::uint32_t>(value);
}

std::array<std::uint32_t, 3> PovParser::indexTriple()
{
  const PovPlace place = this->peek().place;
  const Eigen::Vector3d v = this->vector("a list of indices");
  return { this->index(v[0], place), this->index(v[1], place), this->index(v[2], place) };
}

void PovParser::indices(const char* name, std::vector<std::array<std::uint32_t, 3>>& to)
{
  this->list(name, [&] { to.push_back(this->indexTriple()); });
}

void PovParser::faces(PovMesh& mesh)
{
  bool several = false;
  const PovPlace begin = this->peek().place;
  this->list("face_indices",
    [&]
    {
      PovMesh::Face face;
      face.vertex = this->indexTriple();
      for (int i = 0; i < 3; ++i)
      {
        this->accept(',');
        if (this->peek().is('<') || this->peek().is('}'))
        {
          break;
        }
        const PovPlace place = this->peek().place;
        const auto texture = static_cast<std::int32_t>(this->index(this->scalar(this->expression(), place), place));
        several = several || (i > 0 && texture != face.texture);
        face.texture = i == 0 ? texture : face.texture;
      }
      mesh.faces.push_back(face);
    });
  if (several)
  {
    this->warn(begin, "faces of several textures are drawn with their first one");
  }
}

PovShape PovParser::mesh2()
{
  const Guard guard(*this);
  this->Contexts.emplace_back();
  this->Contexts.back().isMesh = true;
  auto mesh = std::make_shared<PovMesh>();
  std::vector<std::array<std::uint32_t, 3>> normalIndices;
  std::vector<std::array<std::uint32_t, 3>> uvIndices;
  Modifiers modifiers;
  const PovPlace begin = this->peek().place;
  this->expect('{', "mesh2");
  while (!this->accept('}'))
  {
    const PovToken token = this->peek();
    if (this->modifier(modifiers))
    {
      continue;
    }
    this->take();
    if (token.is("vertex_vectors"))
    {
      this->list("vertex_vectors", [&] { mesh->vertices.push_back(this->vector("vertex_vectors")); });
    }
    else if (token.is("normal_vectors"))
    {
      this->list("normal_vectors", [&] { mesh->normals.push_back(this->vector("normal_vectors").cast<float>()); });
    }
    else if (token.is("uv_vectors"))
    {
      this->list("uv_vectors", [&] { mesh->uvs.push_back(this->vector("uv_vectors").head<2>().cast<float>()); });
    }
    else if (token.is("texture_list"))
    {
      this->list("texture_list",
        [&]
        {
          const PovToken word = this->take();
          if (!word.is("texture") && !word.is("material"))
          {
            this->failAt(word, "cannot understand texture_list", "texture");
          }
          mesh->textures.push_back(this->texture(word.text, nullptr));
        });
    }
    else if (token.is("face_indices"))
    {
      this->faces(*mesh);
    }
    else if (token.is("normal_indices"))
    {
      this->indices("normal_indices", normalIndices);
    }
    else if (token.is("uv_indices"))
    {
      this->indices("uv_indices", uvIndices);
    }
    else
    {
      this->failAt(token, "cannot be understood in a mesh2", "vertex_vectors, face_indices, ... or '}'");
    }
  }
  this->Contexts.pop_back();
  const auto corners = [&](const std::vector<std::array<std::uint32_t, 3>>& list, std::size_t count, const char* what,
                         std::array<std::int32_t, 3> PovMesh::Face::*to)
  {
    if (!list.empty() && list.size() != mesh->faces.size())
    {
      this->fail(begin, std::string(what) + " do not match the faces", std::to_string(mesh->faces.size()),
        std::to_string(list.size()));
    }
    for (std::size_t i = 0; i < mesh->faces.size() && count > 0; ++i)
    {
      // without indices of their own, the vertices' are used
      const std::array<std::uint32_t, 3>& triple = list.empty() ? mesh->faces[i].vertex : list[i];
      for (std::size_t k = 0; k < 3; ++k)
      {
        if (triple[k] >= count && !list.empty())
        {
          this->fail(begin, std::string(what) + " point outside their list", "below " + std::to_string(count),
            std::to_string(triple[k]));
        }
        (mesh->faces[i].*to)[k] = triple[k] < count ? static_cast<std::int32_t>(triple[k]) : -1;
      }
    }
  };
  for (const PovMesh::Face& face : mesh->faces)
  {
    for (const std::uint32_t vertex : face.vertex)
    {
      if (vertex >= mesh->vertices.size())
      {
        this->fail(begin, "face_indices point outside vertex_vectors", "below " + std::to_string(mesh->vertices.size()),
          std::to_string(vertex));
      }
    }
    if (face.texture >= static_cast<std::int32_t>(mesh->textures.size()))
    {
      this->fail(begin, "face_indices point outside texture_list", "below " + std::to_string(mesh->textures.size()),
        std::to_string(face.texture));
    }
  }
  corners(normalIndices, mesh->normals.size(), "normal_indices", &PovMesh::Face::normal);
  corners(uvIndices, mesh->uvs.size(), "uv_indices", &PovMesh::Face::uv);
  PovShape shape(1);
  shape[0].mesh = mesh;
  this->apply(shape, modifiers, true);
  return shape;
}

} // namespace dgtk
