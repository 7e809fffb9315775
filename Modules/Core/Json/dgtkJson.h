// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJson_h
#define dgtkJson_h

#include "dgtkCoreModule.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace dgtk
{

/// A JSON value that knows its line. Members of an object keep their order: children are key, value, key, value, ...
struct DGTKCORE_EXPORT JsonNode
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
  std::string text; ///< any bytes, see utf8FromBytes()
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

/// A tree and how errors name it.
struct JsonDocument
{
  JsonNode root;
  std::string file;
  std::string label = {}; ///< stands before the path of keys
  long line = 0;          ///< serves where the tree knows none
};

/// Parses JSON with comments. Throws InputError with file and line: not JSON, a key given twice, nested deeper than 32,
/// more than `mostValues` values.
DGTKCORE_EXPORT JsonDocument parseJson(
  const std::string& file, const std::string& contents, std::size_t mostValues = 10'000'000);

/// A JSON string with its quotes. Bytes that are not UTF-8 are written as utf8FromBytes() says.
DGTKCORE_EXPORT std::string jsonString(const std::string& text);

/// An interval. `text` says it in an error: "a number from 0 to 1".
struct Range
{
  double least;
  double most;
  bool openLeast;
  bool openMost;
  const char* text;
  bool holds(double v) const
  {
    return (this->openLeast ? v > this->least : v >= this->least) &&
           (this->openMost ? v < this->most : v <= this->most);
  }
};
inline constexpr Range anyNumber{ -1.7976931348623157e308, 1.7976931348623157e308, false, false, "a number" };

/// A value of a document, for typed reading and for errors that name its place. The document must outlive it.
class DGTKCORE_EXPORT JsonCursor
{
public:
  explicit JsonCursor(const JsonDocument& document)
    : Document(&document)
    , Node(&document.root)
  {
  }
  explicit JsonCursor(JsonDocument&&) = delete;

  const JsonNode& node() const { return *this->Node; }
  bool isNull() const { return this->Node->type == JsonNode::Type::Null; }
  bool has(const std::string& key) const { return this->Node->find(key) != nullptr; }
  /// The value of a key; fails unless this is an object that has it.
  JsonCursor operator[](const std::string& key) const;
  /// A member of an object or an element of a list.
  JsonCursor member(std::size_t pair) const { return { *this->Document, this->Node->children[2 * pair + 1] }; }
  JsonCursor element(std::size_t index) const { return { *this->Document, this->Node->children[index] }; }
  const std::string& key(std::size_t pair) const { return this->Node->children[2 * pair].text; }

  const std::string& file() const { return this->Document->file; }
  std::string path() const;
  long line() const { return this->Node->line > 0 ? this->Node->line : this->Document->line; }
  /// Throws InputError: FILE:LINE: path what (expected ..., found ...).
  [[noreturn]] void fail(
    const std::string& what, const std::string& expected = {}, const std::string& found = {}) const;
  [[noreturn]] void failType(const std::string& expected) const;

  // They throw InputError unless the value has the type and lies in the range.
  double number(const Range& range = anyNumber) const;
  double wholeNumber(const Range& range) const;
  bool boolean() const;
  const std::string& text() const;
  /// At most 4096 bytes without control characters, see faultOfText().
  const std::string& string(bool mayBeEmpty = true) const;
  std::size_t listSize() const;              ///< of a list
  std::size_t listSize(std::size_t n) const; ///< n; fails unless it is a list of n
  std::size_t memberCount() const;           ///< of an object
  std::vector<JsonCursor> items() const;     ///< of a list
  /// A list of rows; of a vector: of numbers.
  template <typename Matrix>
  Matrix matrix(const Range& range = anyNumber) const
  {
    Matrix matrix;
    this->listSize(std::size_t(matrix.rows()));
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    {
      const JsonCursor row = this->element(std::size_t(i));
      const bool vector = Matrix::ColsAtCompileTime == 1;
      if (!vector)
      {
        row.listSize(std::size_t(matrix.cols()));
      }
      for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      {
        matrix(i, j) = (vector ? row : row.element(std::size_t(j))).number(range);
      }
    }
    return matrix;
  }
  Eigen::Vector3d vector(const Range& range) const { return this->matrix<Eigen::Vector3d>(range); }
  /// Position of the value in a list of words.
  std::size_t oneOf(const std::vector<std::string>& words) const;

private:
  JsonCursor(const JsonDocument& document, const JsonNode& node)
    : Document(&document)
    , Node(&node)
  {
  }
  const JsonDocument* Document;
  const JsonNode* Node;
};

/// What is expected of a text for people; "" when nothing is wrong with it.
DGTKCORE_EXPORT std::string faultOfText(const std::string& text, bool mayBeEmpty);

} // namespace dgtk

#endif
