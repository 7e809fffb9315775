// SPDX-License-Identifier: BSD-3-Clause
// FBX files made by the tests, text and binary.
#ifndef dgtkFbxMaker_h
#define dgtkFbxMaker_h

#include "dgtkModel.h"

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace dgtk::test
{

/// An element and what is in it.
struct FbxItem
{
  using Value = std::variant<std::int64_t, double, std::string, std::vector<double>, std::vector<std::int64_t>>;

  std::string name;
  std::vector<Value> values{};
  std::vector<FbxItem> children{};
};

/// How a binary file has its numbers.
struct FbxBinary
{
  bool wide = true;       ///< places of 8 bytes (7.5 and later)
  bool compressed = true; ///< lists by zlib
  bool bigEndian = false;
  bool singleLists = false; ///< lists of 32 bits
};

/// A file of objects and their connections.
class FbxMaker
{
public:
  using Numbers = std::vector<double>;
  using Integers = std::vector<std::int64_t>;

  /// Adds an object, and returns its number; `kind` is the class within its element's.
  std::int64_t add(const std::string& type, const std::string& kind, std::vector<FbxItem> children = {},
    const std::string& name = "thing");
  /// A property of an object: numbers, or a text.
  void set(std::int64_t object, const std::string& name, const Numbers& values);
  void setText(std::int64_t object, const std::string& name, const std::string& text);
  /// The object's element, for what is no property.
  FbxItem& item(std::int64_t object);
  void connect(std::int64_t child, std::int64_t parent, const std::string& property = {});

  /// A model in `parent` (0: the scene).
  std::int64_t model(std::int64_t parent = 0, const std::string& name = "model");
  /// A geometry of a model: a triangle at (0, 0, 0), (1, 0, 0), (0, 1, 0) unless told otherwise.
  std::int64_t mesh(
    std::int64_t model, const Numbers& points = { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, const Integers& corners = { 0, 1, -3 });

  /// A stack of so many seconds with one layer, which is returned. Times count from `begin`.
  std::int64_t stack(double seconds, double begin = 0);
  std::int64_t layer(double weight, std::int64_t mode); ///< one more of the last stack
  /// A key, or the first of several that share what follows it.
  struct Key
  {
    double time; ///< seconds
    double value;
    std::int64_t flags = 8 | 0x400; ///< a spline, slopes as said
    double slopes[2]{};             ///< on its right, and on the next key's left
    double weights[2]{ 1. / 3, 1. / 3 };
  };
  /// Lets a curve drive a component ("d|X") of an object's property; returns the curve.
  std::int64_t animate(std::int64_t layer, std::int64_t object, const std::string& property,
    const std::string& component, const std::vector<Key>& keys);

  std::string text() const;
  std::string binary(const FbxBinary& how = {}) const;

  std::int64_t version = 7700;
  double ticks = 46186158000.; ///< a second
  std::vector<FbxItem> header; ///< more of FBXHeaderExtension
  std::vector<FbxItem> definitions;
  std::vector<FbxItem> takes;

private:
  std::vector<FbxItem> document() const;

  std::vector<FbxItem> Objects;
  std::vector<FbxItem> Connections;
  std::int64_t Stack = 0;
};

/// A layer of a geometry ("LayerElementUV", ...).
FbxItem fbxLayer(
  const std::string& type, const std::string& mapping, const std::string& reference, std::vector<FbxItem> values);

/// What the text of a file is read as, which keeps all promises of a model.
std::shared_ptr<const Model> readChecked(const FbxMaker& maker);

} // namespace dgtk::test

#endif
