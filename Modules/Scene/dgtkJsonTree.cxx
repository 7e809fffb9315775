// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJsonTree.h"

#include "dgtkError.h"
#include "dgtkSceneText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <unordered_set>

namespace dgtk::scenefile
{

namespace
{
constexpr std::size_t largestDepth = 32;
constexpr std::size_t largestCount = 10'000'000;

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
  TreeBuilder(const std::string& file, const int& line)
    : File(file)
    , Line(line)
  {
  }
  JsonNode take() { return std::move(this->Root); }

  bool null() override { return this->put(JsonNode()); }
  bool boolean(bool value) override { return this->put(JsonNode::of(value)); }
  bool number_integer(number_integer_t value) override { return this->put(JsonNode::of(double(value))); }
  bool number_unsigned(number_unsigned_t value) override { return this->put(JsonNode::of(double(value))); }
  bool number_float(number_float_t, const string_t& text) override
  {
    std::string plain = text; // the lexer may have put the locale's decimal point
    std::replace(plain.begin(), plain.end(), ',', '.');
    double value = 0;
    const std::string fault = parseNumber(plain, value);
    if (!fault.empty())
    {
      throw InputError(this->File, this->Line, "number cannot be used", fault, quoted(text));
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
    if (++this->Count > largestCount)
    {
      throw InputError(this->File, this->Line, "has too many values", "at most " + std::to_string(largestCount));
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
  JsonNode Root;
  std::vector<JsonNode*> Open;
  std::vector<std::unordered_set<std::string>> Keys;
  std::size_t Count = 0;
};

bool isShort(const JsonNode& node, std::size_t& budget)
{
  if (node.type == JsonNode::Type::Object)
  {
    return node.children.empty();
  }
  const std::size_t size = node.type == JsonNode::Type::Array    ? 2
                           : node.type == JsonNode::Type::String ? node.text.size() + 4
                           : node.type == JsonNode::Type::Number ? numberText(node.number).size() + 2
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
      out += node.number == 0 && std::signbit(node.number) ? "-0.0" : numberText(node.number);
      break;
    case JsonNode::Type::String:
      out += nlohmann::json(utf8FromBytes(node.text)).dump();
      break;
    default:
      printContainer(node, indentation, out);
  }
}
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
      return numberText(this->number);
    case Type::String:
      return quoted(this->text);
    case Type::Array:
      return "a list of " + std::to_string(this->children.size());
    default:
      return "an object";
  }
}

JsonNode parseJson(const std::string& file, const std::string& contents)
{
  int line = 1;
  TreeBuilder builder(file, line);
  nlohmann::json::sax_parse(LineIterator(contents.data(), &line),
    LineIterator(contents.data() + contents.size(), &line), &builder, nlohmann::json::input_format_t::json, true, true);
  return builder.take();
}

std::string printJson(const JsonNode& root)
{
  std::string out;
  print(root, 0, out);
  return out + '\n';
}

} // namespace dgtk::scenefile
