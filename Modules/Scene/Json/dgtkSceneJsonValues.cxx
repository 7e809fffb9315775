// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneJson.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>

namespace dgtk::scenefile
{

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

void failKey(const JsonCursor& at, std::size_t pair, const std::vector<std::string>& known)
{
  const std::string near = suggestion(at.key(pair), known);
  throw InputError(at.file(), at.node().children[2 * pair].line, at.member(pair).path() + " is an unknown key",
    near.empty() ? "one of " + joined(known) : "perhaps " + quoted(near), quoted(at.key(pair)));
}

Eigen::Vector3d readScale(const JsonCursor& at)
{
  const bool uniform = at.node().type == JsonNode::Type::Number;
  Eigen::Vector3d s =
    uniform ? Eigen::Vector3d(Eigen::Vector3d::Constant(at.number(rules::scale))) : at.vector(rules::scale);
  for (int i = 0; i < 3; ++i)
  {
    if (s[i] == 0)
    {
      const JsonCursor zero = uniform ? at : at.element(std::size_t(i));
      zero.fail("is out of range", rules::scale.text, "0");
    }
  }
  return s;
}

Quaternion readQuaternion(const JsonCursor& at)
{
  const auto v = at.matrix<Eigen::Vector4d>(rules::coordinate);
  const Quaternion q{ v[0], v[1], v[2], v[3] };
  const std::string fault = faultOf(q);
  if (!fault.empty())
  {
    at.fail("is not a rotation", fault, "length " + plainNumber(q.norm()));
  }
  return q;
}

namespace
{
bool isShort(const JsonNode& node, std::size_t& budget)
{
  if (node.type == JsonNode::Type::Object)
  {
    return node.children.empty();
  }
  const std::size_t size = node.type == JsonNode::Type::Array    ? 2
                           : node.type == JsonNode::Type::String ? node.text.size() + 4
                           : node.type == JsonNode::Type::Number ? plainNumber(node.number).size() + 2
                                                                 : 7;
  if (size > budget)
  {
    return false;
  }
  budget -= size;
  return std::all_of(
    node.children.begin(), node.children.end(), [&budget](const JsonNode& child) { return isShort(child, budget); });
}

bool fitsOneLine(const JsonNode& node)
{
  std::size_t budget = 100;
  return isShort(node, budget);
}

void print(const JsonNode& node, std::size_t indentation, std::string& out);

void printContainer(const JsonNode& node, std::size_t indentation, std::string& out)
{
  const bool object = node.type == JsonNode::Type::Object;
  const bool oneLine = fitsOneLine(node);
  out += object ? '{' : '[';
  for (std::size_t i = 0; i < node.children.size(); ++i)
  {
    if (oneLine)
    {
      out += i == 0 ? "" : ", ";
    }
    else
    {
      out += i == 0 ? "\n" : ",\n";
      out.append(indentation + 2, ' ');
    }
    print(node.children[i], indentation + 2, out);
    if (object)
    {
      out += ": ";
      print(node.children[++i], indentation + 2, out);
    }
  }
  if (!oneLine)
  {
    out += '\n';
    out.append(indentation, ' ');
  }
  out += object ? '}' : ']';
}

void print(const JsonNode& node, std::size_t indentation, std::string& out)
{
  switch (node.type)
  {
    case JsonNode::Type::Null:
      out += "null";
      break;
    case JsonNode::Type::Boolean:
      out += node.boolean ? "true" : "false";
      break;
    case JsonNode::Type::Number:
      // -0 would be read as an integer, which has no sign of zero.
      out += node.number == 0 && std::signbit(node.number) ? "-0.0" : plainNumber(node.number);
      break;
    case JsonNode::Type::String:
      out += jsonString(node.text);
      break;
    default:
      printContainer(node, indentation, out);
  }
}
} // namespace

std::string printJson(const JsonNode& root)
{
  std::string out;
  print(root, 0, out);
  return out + '\n';
}

} // namespace dgtk::scenefile
