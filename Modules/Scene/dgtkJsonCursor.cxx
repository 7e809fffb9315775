// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJsonCursor.h"

#include "dgtkError.h"
#include "dgtkSceneText.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>

namespace dgtk::scenefile
{

JsonCursor::JsonCursor(const JsonNode& node, const std::string& file, const std::string& label, long line)
  : Node(&node)
  , File(&file)
  , Label(&label)
  , Line(line)
{
}

JsonCursor::JsonCursor(const JsonNode& node, const JsonCursor& parent, const std::string* key, std::size_t index)
  : Node(&node)
  , Parent(&parent)
  , Key(key)
  , Index(index)
  , File(parent.File)
  , Label(parent.Label)
  , Line(parent.Line)
{
}

JsonCursor JsonCursor::member(std::size_t pair) const
{
  return { this->Node->children[2 * pair + 1], *this, &this->Node->children[2 * pair].text, 0 };
}

JsonCursor JsonCursor::element(std::size_t index) const
{
  return { this->Node->children[index], *this, nullptr, index };
}

std::string JsonCursor::path() const
{
  if (!this->Parent)
  {
    return *this->Label;
  }
  std::string text = this->Parent->path();
  if (!this->Key)
  {
    return text + '[' + std::to_string(this->Index) + ']';
  }
  text += text.empty() || text.back() == ' ' ? "" : ".";
  const std::string shown = quoted(*this->Key);
  return text + shown.substr(1, shown.size() - 2);
}

long JsonCursor::line() const { return this->Node->line > 0 ? this->Node->line : this->Line; }

void JsonCursor::fail(const std::string& what, const std::string& expected, const std::string& found) const
{
  const std::string where = this->path();
  throw InputError(*this->File, this->line(), where.empty() ? what : where + ' ' + what, expected, found);
}

void JsonCursor::failType(const std::string& expected) const
{
  this->fail("has the wrong type", expected, this->Node->described());
}

namespace
{
/// What other programs call it.
struct OtherName
{
  const char* theirs;
  const char* ours;
};
constexpr OtherName otherNames[] = { { "rotation", "orientation" }, { "rotate", "orientation" },
  { "quaternion", "orientation" }, { "translation", "position" }, { "translate", "position" },
  { "location", "position" }, { "target", "lookAt" }, { "fov", "fovY" }, { "mesh", "model" }, { "file", "model" } };

std::string suggestion(const std::string& key, const std::vector<std::string>& known)
{
  for (const OtherName& name : otherNames)
  {
    if (key == name.theirs && std::find(known.begin(), known.end(), name.ours) != known.end())
    {
      return name.ours;
    }
  }
  return nearest(key, known);
}
} // namespace

void JsonCursor::failKey(std::size_t pair, const std::vector<std::string>& known) const
{
  const std::string near = suggestion(this->key(pair), known);
  const JsonCursor at = this->member(pair);
  throw InputError(*this->File, this->Node->children[2 * pair].line, at.path() + " is an unknown key",
    near.empty() ? "one of " + joined(known) : "perhaps " + quoted(near), quoted(this->key(pair)));
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

const std::string& JsonCursor::string(bool mayBeEmpty) const
{
  if (this->Node->type != JsonNode::Type::String)
  {
    this->failType("a text in quotes");
  }
  const std::string fault = faultOfText(this->Node->text, mayBeEmpty);
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

Eigen::Vector3d JsonCursor::vector(const Range& range) const
{
  this->listSize(3);
  return { this->element(0).number(range), this->element(1).number(range), this->element(2).number(range) };
}

Eigen::Vector3d JsonCursor::scale() const
{
  const bool uniform = this->Node->type == JsonNode::Type::Number;
  Eigen::Vector3d s =
    uniform ? Eigen::Vector3d(Eigen::Vector3d::Constant(this->number(rules::scale))) : this->vector(rules::scale);
  for (int i = 0; i < 3; ++i)
  {
    if (s[i] == 0)
    {
      const JsonCursor zero = uniform ? *this : this->element(i);
      zero.fail("is out of range", rules::scale.text, "0");
    }
  }
  return s;
}

Quaternion JsonCursor::quaternion() const
{
  this->listSize(4);
  const Range& range = rules::coordinate;
  const Quaternion q{ this->element(0).number(range), this->element(1).number(range), this->element(2).number(range),
    this->element(3).number(range) };
  const std::string fault = faultOf(q);
  if (!fault.empty())
  {
    this->fail("is not a rotation", fault, "length " + numberText(q.norm()));
  }
  return q;
}

Eigen::Matrix3d JsonCursor::cameraMatrix() const
{
  Eigen::Matrix3d K;
  this->listSize(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    K.row(i) = this->element(i).vector(rules::coordinate);
  }
  const std::string fault = faultOf(K);
  if (!fault.empty())
  {
    this->fail("is not a camera matrix", fault);
  }
  return K;
}

std::size_t JsonCursor::oneOf(const std::vector<std::string>& words) const
{
  if (this->Node->type == JsonNode::Type::String)
  {
    for (std::size_t i = 0; i < words.size(); ++i)
    {
      if (words[i] == this->Node->text)
      {
        return i;
      }
    }
  }
  this->fail("is not known", "one of " + joined(words), this->Node->described());
}

} // namespace dgtk::scenefile
