// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonTree_h
#define dgtkJsonTree_h

// Private to Scene.

#include <cstddef>
#include <string>
#include <vector>

namespace dgtk::scenefile
{

/// A JSON value that knows its line. Members of an object keep their order: children are key, value, key, value, ...
struct JsonNode
{
  enum class Type : unsigned char
  {
    Null,
    Boolean,
    Number,
    String,
    Array,
    Object
  };
  Type type = Type::Null;
  bool boolean = false;
  int line = 0; ///< from 1; 0 for a tree that was not read
  double number = 0;
  std::string text;
  std::vector<JsonNode> children;

  JsonNode() = default;
  explicit JsonNode(Type t)
    : type(t)
  {
  }
  static JsonNode of(double value);
  static JsonNode of(bool value);
  static JsonNode of(const std::string& value);
  static JsonNode of(const char* value) { return of(std::string(value)); }

  /// The value of a key of an object, or null.
  const JsonNode* find(const std::string& key) const;
  void add(const std::string& key, JsonNode value);
  /// "a list", "an object", "'text'", "12": what an error says was found.
  std::string described() const;
};

/// Parses JSON with comments. Throws InputError with file and line: not JSON, a key given twice, nested deeper than 32,
/// more than 10 million values.
JsonNode parseJson(const std::string& file, const std::string& contents);

/// Text of a tree, two spaces an indentation, arrays of scalars and short arrays on one line; ends with a newline.
std::string printJson(const JsonNode& root);

} // namespace dgtk::scenefile

#endif
