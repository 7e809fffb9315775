// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxDocument_h
#define dgtkFbxDocument_h

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dgtk::import
{

/// A value of an element: a number, a text, or a list of numbers.
using FbxValue = std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>, std::vector<double>>;

/// An element of an FBX file, binary or text: `Name: value, value { children }`.
struct FbxElement
{
  std::string name;
  std::vector<FbxValue> values;
  std::vector<FbxElement> children;

  /// The first child of that name, or null.
  const FbxElement* find(std::string_view child) const;
  /// Text of value `index`, or "".
  const std::string& text(std::size_t index) const;
  /// Number of value `index`, or `otherwise`.
  double number(std::size_t index, double otherwise) const;
  std::int64_t integer(std::size_t index, std::int64_t otherwise) const;
  /// All numbers of a child, a list's or the values themselves; none where there is no such child.
  std::vector<double> numbers(std::string_view child) const;
  std::vector<std::int64_t> integers(std::string_view child) const;
};

/// The elements of a file as children of one without a name. Throws std::runtime_error where it is not as it should be,
/// or asks for more memory than `budget` bytes.
FbxElement readFbxDocument(const std::string& bytes, std::uint64_t budget);

/// Version of the format: 7400 for 7.4. 0 where it is not said.
std::int64_t fbxVersion(const std::string& bytes, const FbxElement& document);

} // namespace dgtk::import

#endif
