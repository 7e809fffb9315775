// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovMeshReader.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Index of an item that is appended.
template <class Item>
std::int32_t added(std::vector<Item>& to, const Item& item)
{
  to.push_back(item);
  return static_cast<std::int32_t>(to.size()) - 1;
}

} // namespace

std::uint32_t PovShapeMaker::vertex(const Eigen::Vector3d& position)
{
  this->Mesh->isNumbered = false;
  const auto next = static_cast<std::uint32_t>(this->Mesh->vertices.size());
  const std::array<double, 3> key = { position.x() + 0.0, position.y() + 0.0, position.z() + 0.0 };
  const auto [known, isNew] =
    position.allFinite() ? this->Known.try_emplace(key, next) : std::make_pair(this->Known.end(), true);
  if (isNew)
  {
    this->Mesh->vertices.push_back(position);
  }
  return isNew ? next : known->second;
}

std::int32_t PovShapeMaker::normal(const Eigen::Vector3d& direction)
{
  return added(this->Mesh->normals, Eigen::Vector3f(direction.cast<float>()));
}

std::int32_t PovShapeMaker::uv(const Eigen::Vector2d& uv)
{
  return added(this->Mesh->uvs, Eigen::Vector2f(uv.cast<float>()));
}

std::int32_t PovShapeMaker::texture(const PovTexturePointer& texture)
{
  const auto next = static_cast<std::int32_t>(this->Mesh->textures.size());
  const auto [known, isNew] = this->KnownTextures.try_emplace(texture, next);
  if (isNew)
  {
    this->Mesh->textures.push_back(texture);
  }
  return known->second;
}

void PovShapeMaker::add(const PovShape& shape)
{
  if (this->hasTriangles())
  {
    this->Shape.emplace_back();
    this->Shape.back().mesh = std::exchange(this->Mesh, std::make_shared<PovMesh>());
    this->Known.clear();
    this->KnownTextures.clear();
  }
  this->Shape.insert(this->Shape.end(), shape.begin(), shape.end());
}

PovShape PovShapeMaker::take()
{
  this->add(PovShape());
  return std::move(this->Shape);
}

/// `{ corner, corner, corner ... }` after triangle or smooth_triangle.
void PovMeshReader::triangle(bool smooth, PovShapeMaker& to)
{
  const PovStream::Level level(this->Stream);
  const PovSession::Block block(this->Session, true);
  const char* const name = smooth ? "smooth_triangle" : "triangle";
  this->Stream.expect('{', name);
  Eigen::Vector3d corners[3];
  Eigen::Vector3d normals[3];
  const auto vector = [this](const char* where)
  {
    Eigen::Vector3d v = this->Session.evaluator.vector(where);
    this->Stream.accept(',');
    return v;
  };
  for (int i = 0; i < 3; ++i)
  {
    corners[i] = vector(name);
    normals[i] = smooth ? vector(name) : Eigen::Vector3d(0, 0, 0);
  }
  PovMesh::Face face;
  PovModifiers modifiers;
  while (!this->Stream.accept('}'))
  {
    if (this->Stream.accept("uv_vectors"))
    {
      for (std::int32_t& uv : face.uv)
      {
        uv = to.uv(vector("uv_vectors").head<2>());
      }
    }
    else if (this->Stream.peek().is("texture_list"))
    {
      this->Stream.failAt(this->Stream.peek(), "a triangle of three textures is not evaluated", "one texture");
    }
    else if (!this->Appearance.modifier(modifiers))
    {
      this->Stream.failAt(this->Stream.peek(), std::string("cannot be understood in a ") + name, "a modifier or '}'");
    }
  }
  if (modifiers.invisible)
  {
    return;
  }
  const Eigen::Matrix3d linear = modifiers.transform.linear();
  const bool turns = linear.determinant() != 0;
  const Eigen::Matrix3d turn = turns ? Eigen::Matrix3d(linear.inverse().transpose()) : Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    face.vertex[i] = to.vertex(modifiers.transform * corners[i]);
    face.normal[i] = smooth ? to.normal(turn * normals[i]) : -1;
  }
  face.texture = modifiers.texture ? to.texture(modifiers.texture) : -1;
  to.add(face);
}

PovShape PovMeshReader::mesh()
{
  const PovStream::Level level(this->Stream);
  const PovSession::Block block(this->Session, true);
  this->Stream.expect('{', "mesh");
  PovShapeMaker maker;
  PovModifiers modifiers;
  PovShape shape;
  if (this->Session.symbols.find(this->Stream.peek(), PovValue::Kind::Shape))
  {
    shape = this->Session.use(this->Stream.take()).shape;
  }
  while (!this->Stream.accept('}'))
  {
    const PovToken token = this->Stream.peek();
    if (this->Stream.accept("triangle") || this->Stream.accept("smooth_triangle"))
    {
      this->triangle(token.is("smooth_triangle"), maker);
    }
    else if (!this->Appearance.modifier(modifiers))
    {
      this->Stream.failAt(token, "cannot be understood in a mesh", "triangle, smooth_triangle, a modifier or '}'");
    }
  }
  shape = maker.hasTriangles() ? maker.take() : shape;
  if (shape.empty())
  {
    shape.emplace_back();
    shape.back().mesh = std::make_shared<PovMesh>();
  }
  modifiers.apply(shape, true);
  return shape;
}

/// `{ COUNT, item, item, ... }`; the count must be right.
template <class Item>
void PovMeshReader::list(const char* name, Item item)
{
  this->Stream.expect('{', name);
  const PovPlace place = this->Stream.peek().place;
  const std::uint32_t claimed = this->index();
  std::uint32_t found = 0;
  this->Stream.accept(',');
  while (!this->Stream.accept('}'))
  {
    item();
    this->Stream.accept(',');
    ++found;
  }
  if (found != claimed)
  {
    this->Stream.fail(place, std::string(name) + " has a wrong count", std::to_string(claimed), std::to_string(found));
  }
}

std::uint32_t PovMeshReader::index(double value, const PovPlace& place) const
{
  if (!(value >= 0 && value < 2147483647.0) || value != std::floor(value))
  {
    this->Stream.fail(place, "is no index or count", "a whole number, 0 or larger");
  }
  return static_cast<std::uint32_t>(value);
}

std::uint32_t PovMeshReader::index()
{
  const PovPlace place = this->Stream.peek().place;
  return this->index(this->Session.evaluator.scalar(), place);
}

std::array<std::uint32_t, 3> PovMeshReader::indexTriple()
{
  const PovPlace place = this->Stream.peek().place;
  const Eigen::Vector3d v = this->Session.evaluator.vector("a list of indices");
  return { this->index(v[0], place), this->index(v[1], place), this->index(v[2], place) };
}

void PovMeshReader::faces(PovMesh& mesh)
{
  bool several = false;
  const PovPlace begin = this->Stream.peek().place;
  this->list("face_indices",
    [&]
    {
      PovMesh::Face face;
      face.vertex = this->indexTriple();
      for (int i = 0; i < 3; ++i)
      {
        this->Stream.accept(',');
        if (this->Stream.peek().is('<') || this->Stream.peek().is('}'))
        {
          break;
        }
        const auto texture = static_cast<std::int32_t>(this->index());
        several = several || (i > 0 && texture != face.texture);
        face.texture = i == 0 ? texture : face.texture;
      }
      mesh.faces.push_back(face);
    });
  if (several)
  {
    this->Session.warn(begin, "faces of several textures are drawn with their first one");
  }
}

/// What stands behind one of the words of a mesh2; false when it is none.
bool PovMeshReader::mesh2List(const PovToken& word, PovMesh& mesh, Triples& normals, Triples& uvs)
{
  const auto vectors = [&](auto add)
  { this->list(word.text.c_str(), [&] { add(this->Session.evaluator.vector(word.text.c_str())); }); };
  const auto triples = [&](Triples& to) { this->list(word.text.c_str(), [&] { to.push_back(this->indexTriple()); }); };
  const auto texture = [&]
  {
    const PovToken kind = this->Stream.take();
    if (!kind.is("texture") && !kind.is("material"))
    {
      this->Stream.failAt(kind, "cannot understand texture_list", "texture");
    }
    mesh.textures.push_back(this->Appearance.texture(kind.text, nullptr));
  };
  const std::map<std::string, std::function<void()>> readers = {
    { "vertex_vectors", [&] { vectors([&](const Eigen::Vector3d& v) { mesh.vertices.push_back(v); }); } },
    { "normal_vectors", [&] { vectors([&](const Eigen::Vector3d& v) { mesh.normals.push_back(v.cast<float>()); }); } },
    { "uv_vectors",
      [&] { vectors([&](const Eigen::Vector3d& v) { mesh.uvs.push_back(v.head<2>().cast<float>()); }); } },
    { "texture_list", [&] { this->list("texture_list", texture); } },
    { "face_indices", [&] { this->faces(mesh); } },
    { "normal_indices", [&] { triples(normals); } },
    { "uv_indices", [&] { triples(uvs); } },
  };
  const auto reader = readers.find(word.text);
  if (word.kind == PovToken::Kind::Word && reader != readers.end())
  {
    reader->second();
    return true;
  }
  return false;
}

void PovMeshReader::checkIndex(std::uint32_t index, std::size_t count, const char* what, const PovPlace& place) const
{
  if (index >= count)
  {
    this->Stream.fail(place, what, "below " + std::to_string(count), std::to_string(index));
  }
}

void PovMeshReader::checkFaces(const PovMesh& mesh, const PovPlace& place) const
{
  for (const PovMesh::Face& face : mesh.faces)
  {
    for (const std::uint32_t vertex : face.vertex)
    {
      this->checkIndex(vertex, mesh.vertices.size(), "face_indices point outside vertex_vectors", place);
    }
    const auto texture = static_cast<std::uint32_t>(std::max(face.texture, 0));
    const std::size_t textures = face.texture < 0 ? 1 : mesh.textures.size();
    this->checkIndex(texture, textures, "face_indices point outside texture_list", place);
  }
}

/// Gives the faces of a mesh2 their normals or texture coordinates, `count` of them; without indices of their own,
/// those of their vertices.
void PovMeshReader::setCorners(PovMesh& mesh, std::array<std::int32_t, 3> PovMesh::Face::*to, const Triples& triples,
  std::size_t count, const std::string& what, const PovPlace& place) const
{
  if (!triples.empty() && triples.size() != mesh.faces.size())
  {
    this->Stream.fail(
      place, what + " do not match the faces", std::to_string(mesh.faces.size()), std::to_string(triples.size()));
  }
  const std::string outside = what + " point outside their list";
  for (std::size_t i = 0; i < mesh.faces.size() && count > 0; ++i)
  {
    PovMesh::Face& face = mesh.faces[i];
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint32_t index = triples.empty() ? face.vertex[k] : triples[i][k];
      this->checkIndex(index, triples.empty() ? mesh.vertices.size() : count, outside.c_str(), place);
      (face.*to)[k] = index < count ? static_cast<std::int32_t>(index) : -1;
    }
  }
}

PovShape PovMeshReader::mesh2()
{
  const PovStream::Level level(this->Stream);
  const PovSession::Block block(this->Session, true);
  auto mesh = std::make_shared<PovMesh>();
  Triples normals;
  Triples uvs;
  PovModifiers modifiers;
  const PovPlace begin = this->Stream.peek().place;
  this->Stream.expect('{', "mesh2");
  while (!this->Stream.accept('}'))
  {
    if (this->Appearance.modifier(modifiers))
    {
      continue;
    }
    const PovToken token = this->Stream.take();
    if (!this->mesh2List(token, *mesh, normals, uvs))
    {
      this->Stream.failAt(token, "cannot be understood in a mesh2", "vertex_vectors, face_indices, ... or '}'");
    }
  }
  this->checkFaces(*mesh, begin);
  this->setCorners(*mesh, &PovMesh::Face::normal, normals, mesh->normals.size(), "normal_indices", begin);
  this->setCorners(*mesh, &PovMesh::Face::uv, uvs, mesh->uvs.size(), "uv_indices", begin);
  PovShape shape(1);
  shape[0].mesh = mesh;
  modifiers.apply(shape, true);
  return shape;
}

} // namespace dgtk
