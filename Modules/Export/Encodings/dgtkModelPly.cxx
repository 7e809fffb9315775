// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelPly.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <cstring>
#include <fstream>
#include <sstream>

namespace dgtk
{

namespace
{
struct Header
{
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  bool hasUvs = false;
  bool hasNumbers = false;
  std::vector<std::string> pictures;
  std::vector<std::string> wraps;
};

Header readHeader(std::istream& stream)
{
  constexpr const char* texture = "comment TextureFile ";
  constexpr const char* wrap = "comment TextureWrap ";
  Header header;
  std::string line;
  while (std::getline(stream, line) && line != "end_header")
  {
    std::istringstream words(line);
    std::string first;
    std::string second;
    words >> first >> second;
    if (first == "element")
    {
      words >> (second == "vertex" ? header.vertices : header.triangles);
    }
    if (line.rfind(texture, 0) == 0)
    {
      header.pictures.push_back(line.substr(std::strlen(texture)));
      header.wraps.emplace_back();
    }
    if (line.rfind(wrap, 0) == 0 && !header.wraps.empty())
    {
      header.wraps.back() = line.substr(std::strlen(wrap));
    }
    header.hasUvs = header.hasUvs || line == "property double s";
    header.hasNumbers = header.hasNumbers || line == "property int texnumber";
  }
  return header;
}

/// Takes values from the bytes, one after another.
struct Values
{
  const std::string& path;
  const std::string& bytes;
  std::size_t at;
  template <typename T, std::size_t N>
  std::array<T, N> take()
  {
    std::array<T, N> values;
    if (this->bytes.size() - this->at < sizeof(values))
    {
      throw InputError(this->path, "ends too early");
    }
    std::memcpy(values.data(), this->bytes.data() + this->at, sizeof(values));
    this->at += sizeof(values);
    return values;
  }
};
} // namespace

std::vector<std::string> picturesOfModel(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  return readHeader(stream).pictures;
}

ModelPly readModelPly(const std::string& path)
{
  const std::string bytes = readFile(path);
  std::istringstream stream(bytes);
  const Header header = readHeader(stream);
  if (!stream)
  {
    throw InputError(path, "is no model of a dataset");
  }
  ModelPly model;
  model.pictures = header.pictures;
  model.wraps = header.wraps;
  Values values{ path, bytes, std::size_t(stream.tellg()) };
  for (std::size_t i = 0; i < header.vertices; ++i)
  {
    model.positions.push_back(values.take<double, 3>());
    model.normals.push_back(values.take<float, 3>());
    if (header.hasUvs)
    {
      model.uvs.push_back(values.take<double, 2>());
    }
    model.colors.push_back(values.take<std::uint8_t, 3>());
  }
  for (std::size_t i = 0; i < header.triangles; ++i)
  {
    const bool triangle = values.take<std::uint8_t, 1>()[0] == 3;
    model.triangles.push_back(values.take<std::uint32_t, 3>());
    const int usual = header.pictures.empty() ? -1 : 0;
    model.textures.push_back(header.hasNumbers ? values.take<std::int32_t, 1>()[0] : usual);
    for (const std::uint32_t corner : model.triangles.back())
    {
      if (!triangle || corner >= header.vertices || model.textures.back() >= int(header.pictures.size()))
      {
        throw InputError(path, "has a face that is no triangle of its vertices");
      }
    }
  }
  return model;
}

} // namespace dgtk
