// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJson.h"

#include "dgtkError.h"
#include "dgtkJsonTree.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace dgtk
{

namespace
{
/// Reads characters and counts the lines before the last one read.
class LineIterator
{
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  LineIterator(const char* at, int* line)
    : At(at)
    , Line(line)
  {
  }
  reference operator*() const { return withoutEnd(*this->At); }
  LineIterator& operator++()
  {
    ++this->At;
    if (this->PreviousEndsLine)
    {
      ++*this->Line;
    }
    this->PreviousEndsLine = this->At[-1] == '\n';
    return *this;
  }
  LineIterator operator++(int)
  {
    LineIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const LineIterator& o) const { return this->At == o.At; }
  bool operator!=(const LineIterator& o) const { return this->At != o.At; }

private:
  const char* At;
  int* Line;
  bool PreviousEndsLine = false;
};
} // namespace

JsonNode JsonNode::of(double value)
{
  JsonNode node(Type::Number);
  node.number = value;
  return node;
}

JsonNode JsonNode::of(bool value)
{
  JsonNode node(Type::Boolean);
  node.boolean = value;
  return node;
}

JsonNode JsonNode::of(const std::string& value)
{
  JsonNode node(Type::String);
  node.text = value;
  return node;
}

const JsonNode* JsonNode::find(const std::string& key) const
{
  for (std::size_t i = 0; this->type == Type::Object && i + 1 < this->children.size(); i += 2)
  {
    if (this->children[i].text == key)
    {
      return &this->children[i + 1];
    }
  }
  return nullptr;
}

void JsonNode::add(const std::string& key, JsonNode value)
{
  this->children.push_back(of(key));
  this->children.push_back(std::move(value));
}

std::string JsonNode::described() const
{
  switch (this->type)
  {
    case Type::Null:
      return "null";
    case Type::Boolean:
      return this->boolean ? "true" : "false";
    case Type::Number:
      return plainNumber(this->number);
    case Type::String:
      return quoted(this->text);
    case Type::Array:
      return "a list of " + std::to_string(this->children.size());
    default:
      return "an object";
  }
}

std::string jsonString(const std::string& text)
{
  constexpr char digits[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : utf8FromBytes(text))
  {
    if (c == '"' || c == '\\')
    {
      out += { '\\', c };
    }
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      out += std::string("\\u00") + digits[c >> 4] + digits[c & 15];
    }
    else
    {
      out += c;
    }
  }
  return out + '"';
}

JsonDocument parseJson(const std::string& file, const std::string& contents, std::size_t mostValues)
{
  if (contents.rfind("\xFF\xFE", 0) == 0 || contents.rfind("\xFE\xFF", 0) == 0)
  {
    throw InputError(file, "is UTF-16", "text in UTF-8");
  }
  int line = 1;
  JsonTreeBuilder builder(file, line, mostValues);
  nlohmann::json::sax_parse(LineIterator(contents.data(), &line),
    LineIterator(contents.data() + contents.size(), &line), &builder, nlohmann::json::input_format_t::json, true, true);
  return { builder.take(), file };
}

} // namespace dgtk
