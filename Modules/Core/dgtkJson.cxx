// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJson.h"

#include "dgtkError.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <unordered_set>

namespace dgtk
{

namespace
{
constexpr std::size_t largestDepth = 32;

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
  reference operator*() const { return *this->At; }
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

class TreeBuilder : public nlohmann::json_sax<nlohmann::json>
{
public:
  TreeBuilder(const std::string& file, const int& line, std::size_t mostValues)
    : File(file)
    , Line(line)
    , Most(mostValues)
  {
  }
  JsonNode take() { return std::move(this->Root); }

  bool null() override { return this->put(JsonNode()); }
  bool boolean(bool value) override { return this->put(JsonNode::of(value)); }
  bool number_integer(number_integer_t value) override { return this->put(JsonNode::of(double(value))); }
  bool number_unsigned(number_unsigned_t value) override { return this->put(JsonNode::of(double(value))); }
  bool number_float(number_float_t, const string_t& text) override
  {
    std::string plain = text; // the lexer's point, and its value, are those of the locale
    std::replace(plain.begin(), plain.end(), ',', '.');
    double value = 0;
    if (std::from_chars(plain.data(), plain.data() + plain.size(), value).ec != std::errc())
    {
      throw InputError(
        this->File, this->Line, "number cannot be used", "a number within the range of double precision", quoted(text));
    }
    return this->put(JsonNode::of(value));
  }
  bool string(string_t& value) override { return this->put(JsonNode::of(bytesFromUtf8(value))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return this->open(JsonNode::Type::Object); }
  bool start_array(std::size_t) override { return this->open(JsonNode::Type::Array); }
  bool end_object() override
  {
    this->Keys.pop_back();
    this->Open.pop_back();
    return true;
  }
  bool end_array() override { return this->end_object(); }
  bool key(string_t& name) override
  {
    if (!this->Keys.back().insert(name).second)
    {
      throw InputError(this->File, this->Line, "key " + dgtk::quoted(name) + " is given twice");
    }
    return this->put(JsonNode::of(bytesFromUtf8(name)));
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override
  {
    std::string text = error.what();
    const std::size_t start = text.find(": ");
    text = start == std::string::npos ? text : text.substr(start + 2);
    text = text.substr(0, 160);
    std::replace_if(
      text.begin(), text.end(), [](char c) { return c < 0x20 || c == 0x7f; }, '?');
    throw InputError(this->File, this->Line, "is not valid JSON: " + text);
  }

private:
  JsonNode* put(JsonNode node)
  {
    if (++this->Count > this->Most)
    {
      throw InputError(this->File, this->Line, "has too many values", "at most " + std::to_string(this->Most));
    }
    node.line = this->Line;
    if (this->Open.empty())
    {
      this->Root = std::move(node);
      return &this->Root;
    }
    this->Open.back()->children.push_back(std::move(node));
    return &this->Open.back()->children.back();
  }
  bool open(JsonNode::Type type)
  {
    if (this->Open.size() >= largestDepth)
    {
      throw InputError(
        this->File, this->Line, "is nested too deeply", "at most " + std::to_string(largestDepth) + " levels");
    }
    // Pointers into vectors stay valid: only the innermost open node grows.
    this->Open.push_back(this->put(JsonNode(type)));
    this->Keys.emplace_back();
    return true;
  }

  const std::string& File;
  const int& Line;
  const std::size_t Most;
  JsonNode Root;
  std::vector<JsonNode*> Open;
  std::vector<std::unordered_set<std::string>> Keys;
  std::size_t Count = 0;
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
  int line = 1;
  TreeBuilder builder(file, line, mostValues);
  nlohmann::json::sax_parse(LineIterator(contents.data(), &line),
    LineIterator(contents.data() + contents.size(), &line), &builder, nlohmann::json::input_format_t::json, true, true);
  return { builder.take(), file };
}

} // namespace dgtk
