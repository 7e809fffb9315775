// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonText_h
#define dgtkJsonText_h

#include "dgtkJson.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// A JSON number, with a point or an exponent, so that readers that tell them apart take it for a real one; null for
/// what is not finite.
std::string jsonNumber(double value);

/// Rows in brackets; a vector (one column) in one pair of brackets.
std::string jsonMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// A list on one line, of texts of its items.
template <typename List, typename Text>
std::string listText(const List& items, const Text& text)
{
  std::string list;
  for (const auto& item : items)
  {
    list += (list.empty() ? "" : ", ") + text(item);
  }
  return '[' + list + ']';
}
/// One number as it is, others as a list.
inline std::string numbersText(const std::vector<double>& numbers)
{
  return numbers.size() == 1 ? jsonNumber(numbers[0]) : listText(numbers, jsonNumber);
}

/// Joins `"key": value` members of one object over lines indented by `indent` spaces.
class JsonObject
{
public:
  explicit JsonObject(int indent)
    : Indent(indent)
  {
  }
  JsonObject& raw(const std::string& key, const std::string& value);
  JsonObject& text(const std::string& key, const std::string& value) { return this->raw(key, jsonString(value)); }
  JsonObject& number(const std::string& key, double value) { return this->raw(key, jsonNumber(value)); }
  JsonObject& integer(const std::string& key, std::int64_t value) { return this->raw(key, std::to_string(value)); }
  JsonObject& boolean(const std::string& key, bool value) { return this->raw(key, value ? "true" : "false"); }
  /// On several lines.
  std::string block() const;
  /// On one line.
  std::string line() const;

private:
  int Indent;
  std::string Block;
  std::string Line;
};

/// Items over lines indented by `indent` spaces.
class JsonArray
{
public:
  explicit JsonArray(int indent)
    : Indent(indent)
  {
  }
  void add(const std::string& item);
  std::string block() const;

private:
  int Indent;
  std::string Items;
};

/// A list under a key of a document's root: text(item) one a line.
template <typename T, typename F>
std::string arrayText(const std::vector<T>& items, F text)
{
  JsonArray array(4);
  for (const T& item : items)
  {
    array.add(text(item));
  }
  return array.block();
}

} // namespace dgtk

#endif
