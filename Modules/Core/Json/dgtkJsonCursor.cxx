// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkJson.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Puts the way from a node to a value below it, if it is there, behind `path`.
bool findPath(const JsonNode& from, const JsonNode* value, std::string& path)
{
  const bool object = from.type == JsonNode::Type::Object;
  const std::size_t length = path.size();
  for (std::size_t i = object; i < from.children.size(); i += 1 + object)
  {
    if (object)
    {
      const std::string shown = quoted(from.children[i - 1].text);
      path += (path.empty() || path.back() == ' ' ? "" : ".") + shown.substr(1, shown.size() - 2);
    }
    else
    {
      path += '[' + std::to_string(i) + ']';
    }
    if (&from.children[i] == value || findPath(from.children[i], value, path))
    {
      return true;
    }
    path.resize(length);
  }
  return false;
}
} // namespace

std::string JsonCursor::path() const
{
  std::string path = this->Document->label;
  findPath(this->Document->root, this->Node, path);
  return path;
}

void JsonCursor::fail(const std::string& what, const std::string& expected, const std::string& found) const
{
  const std::string where = this->path();
  throw InputError(this->file(), this->line(), where.empty() ? what : where + ' ' + what, expected, found);
}

void JsonCursor::failType(const std::string& expected) const
{
  this->fail("has the wrong type", expected, this->Node->described());
}

JsonCursor JsonCursor::operator[](const std::string& key) const
{
  this->memberCount();
  const JsonNode* const value = this->Node->find(key);
  if (!value)
  {
    const std::string where = this->path();
    throw InputError(this->file(), this->line(), where + (where.empty() ? "" : ".") + key + " is missing");
  }
  return { *this->Document, *value };
}

double JsonCursor::number(const Range& range) const
{
  if (this->Node->type != JsonNode::Type::Number)
  {
    this->failType(range.text);
  }
  if (!std::isfinite(this->Node->number) || !range.holds(this->Node->number))
  {
    this->fail("is out of range", range.text, this->Node->described());
  }
  return this->Node->number;
}

double JsonCursor::wholeNumber(const Range& range) const
{
  const double value = this->number(range);
  if (value != std::floor(value))
  {
    this->fail("is not a whole number", range.text, this->Node->described());
  }
  return value;
}

bool JsonCursor::boolean() const
{
  if (this->Node->type != JsonNode::Type::Boolean)
  {
    this->failType("true or false");
  }
  return this->Node->boolean;
}

const std::string& JsonCursor::text() const
{
  if (this->Node->type != JsonNode::Type::String)
  {
    this->failType("a text in quotes");
  }
  return this->Node->text;
}

const std::string& JsonCursor::string(bool mayBeEmpty) const
{
  const std::string fault = faultOfText(this->text(), mayBeEmpty);
  if (!fault.empty())
  {
    this->fail("cannot be used", fault, this->Node->described());
  }
  return this->Node->text;
}

std::size_t JsonCursor::listSize() const
{
  if (this->Node->type != JsonNode::Type::Array)
  {
    this->failType("a list");
  }
  return this->Node->children.size();
}

std::size_t JsonCursor::listSize(std::size_t n) const
{
  if (this->Node->type != JsonNode::Type::Array || this->Node->children.size() != n)
  {
    this->failType("a list of " + std::to_string(n));
  }
  return n;
}

std::size_t JsonCursor::memberCount() const
{
  if (this->Node->type != JsonNode::Type::Object)
  {
    this->failType("an object");
  }
  return this->Node->children.size() / 2;
}

std::vector<JsonCursor> JsonCursor::items() const
{
  std::vector<JsonCursor> all;
  all.reserve(this->listSize());
  for (const JsonNode& child : this->Node->children)
  {
    all.push_back({ *this->Document, child });
  }
  return all;
}

std::size_t JsonCursor::oneOf(const std::vector<std::string>& words) const
{
  const auto found = std::find(words.begin(), words.end(), this->Node->text);
  if (this->Node->type != JsonNode::Type::String || found == words.end())
  {
    this->fail("is not known", "one of " + joined(words), this->Node->described());
  }
  return std::size_t(found - words.begin());
}

std::string faultOfText(const std::string& text, bool mayBeEmpty)
{
  if (text.empty())
  {
    return mayBeEmpty ? "" : "a text that is not empty";
  }
  const bool control =
    std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  return control || text.size() > 4096 ? "at most 4096 bytes without control characters" : "";
}

} // namespace dgtk
