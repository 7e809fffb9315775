// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonCursor_h
#define dgtkJsonCursor_h

// Private to Scene.

#include "dgtkJsonTree.h"
#include "dgtkSceneRules.h"

#include <string>
#include <vector>

namespace dgtk::scenefile
{

/// A value of a JSON document together with the way to it, for typed reading and for errors.
class JsonCursor
{
public:
  /// `label` stands before the key path in errors; `line` serves where the tree knows none. All must outlive this.
  JsonCursor(const JsonNode& node, const std::string& file, const std::string& label, long line = 0);

  const JsonNode& node() const { return *this->Node; }
  /// A member of an object or an element of a list; this must outlive it.
  JsonCursor member(std::size_t pair) const;
  JsonCursor element(std::size_t index) const;

  const std::string& file() const { return *this->File; }
  std::string path() const;
  long line() const;
  /// Throws InputError: FILE:LINE: path what (expected ..., found ...).
  [[noreturn]] void fail(
    const std::string& what, const std::string& expected = {}, const std::string& found = {}) const;
  [[noreturn]] void failType(const std::string& expected) const;
  [[noreturn]] void failKey(std::size_t pair, const std::vector<std::string>& known) const;

  // They throw InputError unless the value has the type and lies in the range.
  double number(const Range& range) const;
  double wholeNumber(const Range& range) const;
  bool boolean() const;
  const std::string& string(bool mayBeEmpty = true) const;
  std::size_t listSize() const;              ///< of a list
  std::size_t listSize(std::size_t n) const; ///< n; fails unless it is a list of n
  std::size_t memberCount() const;           ///< of an object
  const std::string& key(std::size_t pair) const { return this->Node->children[2 * pair].text; }
  Eigen::Vector3d vector(const Range& range) const;
  Eigen::Vector3d scale() const; ///< a vector without zeros, or one number for all axes
  Quaternion quaternion() const;
  Eigen::Matrix3d cameraMatrix() const;
  /// Position of the value in a list of words.
  std::size_t oneOf(const std::vector<std::string>& words) const;

private:
  JsonCursor(const JsonNode& node, const JsonCursor& parent, const std::string* key, std::size_t index);
  const JsonNode* Node;
  const JsonCursor* Parent = nullptr;
  const std::string* Key = nullptr;
  std::size_t Index = 0;
  const std::string* File;
  const std::string* Label;
  long Line;
};

} // namespace dgtk::scenefile

#endif
