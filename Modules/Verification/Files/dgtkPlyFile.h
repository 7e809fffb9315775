// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPlyFile_h
#define dgtkPlyFile_h

// Private to Verification: the models of a dataset.

#include "dgtkError.h"
#include "dgtkFile.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <cstring>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace dgtk
{

/// One corner of a triangle in the file.
struct PlyVertex
{
  Eigen::Vector3d x{ 0, 0, 0 };
  Eigen::Vector3f normal{ 0, 0, 0 };
  Eigen::Vector2d uv{ 0, 0 };
  std::array<std::uint8_t, 3> color{ 0, 0, 0 };
};

/// A .ply as DGTk writes models.
class PlyFile
{
public:
  explicit PlyFile(const std::string& path)
    : Path(path)
    , Data(readFile(path))
  {
    std::istringstream header(this->Data);
    std::string line;
    std::string element;
    while (std::getline(header, line) && line != "end_header")
    {
      std::istringstream words(line);
      std::string first;
      std::string second;
      words >> first >> second;
      if (first == "element")
      {
        element = second;
        words >> (element == "vertex" ? this->VertexCount : this->TriangleCount);
      }
      else if (first == "comment" && second == "TextureFile")
      {
        words >> second;
        this->Pictures.push_back(second);
        this->Wraps.emplace_back();
      }
      else if (first == "comment" && second == "TextureWrap" && !this->Wraps.empty())
      {
        words >> second;
        this->Wraps.back() = second;
        words >> second;
        this->Wraps.back() += ' ' + second;
      }
      else if (first == "property")
      {
        std::string name;
        words >> name;
        this->HasUvs = this->HasUvs || name == "s";
        this->HasNumbers = this->HasNumbers || name == "texnumber";
      }
    }
    this->At = line == "end_header" && header ? std::size_t(header.tellg()) : this->Data.size();
    this->readVertices();
    this->readTriangles();
  }

  /// Whether its first lines are those of DGTk's models with its own numbers, and nothing follows the last triangle.
  bool isWellFormed() const
  {
    std::ostringstream header;
    header << "ply\nformat binary_little_endian 1.0\n";
    for (std::size_t i = 0; i < this->Pictures.size(); ++i)
    {
      header << "comment TextureFile " << this->Pictures[i] << '\n';
      header << (this->Wraps[i].empty() ? "" : "comment TextureWrap " + this->Wraps[i] + '\n');
    }
    header << "element vertex " << this->Vertices.size()
           << "\nproperty double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float ny"
              "\nproperty float nz"
           << (this->HasUvs ? "\nproperty double s\nproperty double t" : "")
           << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face " << this->Triangles.size()
           << "\nproperty list uchar int vertex_indices" << (this->HasNumbers ? "\nproperty int texnumber" : "")
           << "\nend_header\n";
    const std::string text = header.str();
    const std::set<std::string> different(this->Pictures.begin(), this->Pictures.end());
    return different.size() == this->Pictures.size() && this->Data.compare(0, text.size(), text) == 0 &&
           this->At == this->Data.size();
  }

  const std::vector<std::string>& pictures() const { return this->Pictures; }
  bool hasUvs() const { return this->HasUvs; }
  std::size_t vertices() const { return this->Vertices.size(); }
  const PlyVertex& vertex(std::size_t i) const { return this->Vertices[i]; }
  const std::array<std::int32_t, 3>& triangle(std::size_t i) const { return this->Triangles[i]; }
  std::size_t triangles() const { return this->Triangles.size(); }
  const PlyVertex& corner(std::size_t triangle, int k) const
  {
    return this->Vertices[std::size_t(this->Triangles[triangle][std::size_t(k)])];
  }
  /// Name of the picture on a triangle; "" for none.
  std::string picture(std::size_t triangle) const { return this->ofTriangle(this->Pictures, triangle); }
  /// "clamp mirror": what is beyond the picture on a triangle, along u and v; "" where it repeats.
  std::string wrap(std::size_t triangle) const { return this->ofTriangle(this->Wraps, triangle); }

private:
  std::string ofTriangle(const std::vector<std::string>& of, std::size_t triangle) const
  {
    const std::int32_t number = this->HasNumbers ? this->Numbers[triangle] : 0;
    return number < 0 || std::size_t(number) >= of.size() ? "" : of[std::size_t(number)];
  }
  template <typename T>
  void take(T* values, std::size_t count)
  {
    if (this->Data.size() - this->At < sizeof(T) * count)
    {
      throw InputError(this->Path, "ends too early");
    }
    std::memcpy(values, this->Data.data() + this->At, sizeof(T) * count);
    this->At += sizeof(T) * count;
  }

  void readVertices()
  {
    for (std::size_t i = 0; i < this->VertexCount; ++i)
    {
      PlyVertex vertex;
      this->take(vertex.x.data(), 3);
      this->take(vertex.normal.data(), 3);
      this->take(vertex.uv.data(), this->HasUvs ? 2 : 0);
      this->take(vertex.color.data(), 3);
      this->Vertices.push_back(vertex);
    }
  }
  void readTriangles()
  {
    for (std::size_t i = 0; i < this->TriangleCount; ++i)
    {
      std::uint8_t corners = 0;
      std::array<std::int32_t, 3> vertices{};
      std::int32_t number = 0;
      this->take(&corners, 1);
      this->take(vertices.data(), 3);
      this->take(&number, this->HasNumbers ? 1 : 0);
      for (const std::int32_t vertex : vertices)
      {
        if (corners != 3 || vertex < 0 || std::size_t(vertex) >= this->Vertices.size())
        {
          throw InputError(this->Path, "has a face that is no triangle of its vertices");
        }
      }
      this->Triangles.push_back(vertices);
      this->Numbers.push_back(number);
    }
  }

  std::string Path;
  std::string Data;
  std::size_t At = 0;
  std::size_t VertexCount = 0;
  std::size_t TriangleCount = 0;
  bool HasUvs = false;
  bool HasNumbers = false;
  std::vector<std::string> Pictures;
  std::vector<std::string> Wraps;
  std::vector<PlyVertex> Vertices;
  std::vector<std::array<std::int32_t, 3>> Triangles;
  std::vector<std::int32_t> Numbers;
};

} // namespace dgtk

#endif
