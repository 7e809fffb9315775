// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGltfFile_h
#define dgtkGltfFile_h

#include "dgtkAssimpGltf.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>

namespace dgtk::import
{

/// The JSON of a .gltf or .glb, and the numbers of its buffers. All methods throw std::exception where the file is not
/// as it should be.
class GltfFile
{
public:
  using Json = nlohmann::json;
  static constexpr int floatType = 5126; ///< of an accessor's components

  [[noreturn]] static void fail(const char* what);
  GltfFile(const std::string& path, const ReadContents& contentsOf);

  const Json& root() const { return this->Root; }
  /// The file, whose bytes are handed in, with sorted names, a scene, without extras that are no objects and without
  /// sparse values over rows with gaps. Primitives of which nothing can be drawn are points, those without vertices
  /// with the places of another one. root() is that, too, afterwards.
  std::string inOrder(const std::string& bytes);
  /// How many vertices a primitive has.
  std::size_t vertices(const Json& primitive) const;
  /// Whether an accessor, or one of all, has sparse values over rows with gaps.
  bool hasSparseGaps(const Json& accessor) const;
  bool hasSparseGaps() const;
  /// Item `index` of a list of the file.
  const Json& item(const char* list, std::size_t index) const { return this->Root.at(list).at(index); }
  /// What integers of an accessor are.
  enum class Integers
  {
    Shares, ///< of the largest of their type, in [-1, 1]
    AsSaid  ///< that only where the accessor says so
  };
  /// All components of an accessor.
  std::vector<double> numbers(std::size_t index, std::size_t components, Integers integers = Integers::Shares);
  /// Those of an attribute of a mesh.
  std::vector<double> ofVertices(std::size_t index, std::size_t components, Integers integers, const Mesh& mesh);

private:
  bool drawsNothing(const Json& primitive);
  void replaceEmpty();
  const std::string& buffer(std::size_t index);
  std::vector<double> list(const Json& where, int type, std::size_t count, std::size_t components, bool normalized);

  std::filesystem::path Folder;
  ReadContents ContentsOf;
  Json Root;
  std::size_t End = 0; ///< of the JSON in the file
  std::string Binary;
  std::map<std::size_t, std::string> Buffers;
};

/// Node of the file -> node of the scene, by the shape of the tree: names need not be unique.
class NodeMatch
{
public:
  NodeMatch(const GltfFile& file, const Scene& scene);

  std::int32_t of(std::size_t node) const
  {
    const auto found = this->Index.find(node);
    return found == this->Index.end() ? noIndex : found->second;
  }

private:
  void match(std::size_t node, std::size_t index);
  void matchAll(const GltfFile::Json& nodes, const std::vector<std::size_t>& indices);

  const GltfFile& File;
  const Scene& Whole;
  std::vector<std::vector<std::size_t>> Children;
  std::map<std::size_t, std::int32_t> Index;
};

} // namespace dgtk::import

#endif
