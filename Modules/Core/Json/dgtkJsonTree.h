// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonTree_h
#define dgtkJsonTree_h

// Private to Core: trees of JSON as they are read.

#include "dgtkError.h"
#include "dgtkJson.h"
#include "dgtkJsonFault.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace dgtk
{

/// What the parser is given: it takes a character 0 for the end of the text, and would ignore what follows.
inline const char& withoutEnd(const char& c)
{
  static constexpr char invalid = 1;
  return c != '\0' ? c : invalid;
}

/// Makes a tree of what the parser reads; takes the number of the line from where the parser reads.
class JsonTreeBuilder : public nlohmann::json_sax<nlohmann::json>
{
public:
  JsonTreeBuilder(const std::string& file, const int& line, std::size_t mostValues)
    : File(file)
    , Line(line)
    , Most(mostValues)
  {
  }
  JsonNode take() { return std::move(this->Root); }

  bool null() override { return this->scalar(JsonNode()); }
  bool boolean(bool value) override { return this->scalar(JsonNode::of(value)); }
  bool number_integer(number_integer_t value) override { return this->scalar(JsonNode::of(double(value))); }
  bool number_unsigned(number_unsigned_t value) override { return this->scalar(JsonNode::of(double(value))); }
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
    return this->scalar(JsonNode::of(value));
  }
  bool string(string_t& value) override { return this->scalar(JsonNode::of(bytesFromUtf8(value))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return this->open(JsonNode::Type::Object); }
  bool start_array(std::size_t) override { return this->open(JsonNode::Type::Array); }
  bool end_object() override
  {
    this->Keys.pop_back();
    this->Open.pop_back();
    this->ended();
    return true;
  }
  bool end_array() override { return this->end_object(); }
  bool key(string_t& name) override
  {
    if (!this->Keys.back().insert(name).second)
    {
      throw InputError(this->File, this->Line, "key " + dgtk::quoted(name) + " is given twice");
    }
    return this->put(JsonNode::of(bytesFromUtf8(name))) != nullptr;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override
  {
    throw jsonFault(this->File, this->Line, error.what());
  }

protected:
  /// A value has begun (an object or a list), or ended: depth() is that of what holds it.
  virtual void began() {}
  virtual void ended() {}
  std::size_t depth() const { return this->Open.size(); }
  bool rootIsObject() const { return this->Open.front()->type == JsonNode::Type::Object; }
  JsonNode& holder() { return *this->Open.back(); }
  /// The key at the root whose value is read.
  const std::string& rootKey() const
  {
    return this->Open.front()->children[this->Open.front()->children.size() - 2].text;
  }
  /// Takes the last value out of the list that holds it.
  JsonNode takeLast()
  {
    JsonNode last = std::move(this->holder().children.back());
    this->holder().children.pop_back();
    this->Count -= valuesOf(last);
    return last;
  }
  const std::string& file() const { return this->File; }

private:
  static std::size_t valuesOf(const JsonNode& node)
  {
    std::size_t values = 1;
    for (const JsonNode& child : node.children)
    {
      values += valuesOf(child);
    }
    return values;
  }
  bool scalar(JsonNode node)
  {
    this->put(std::move(node));
    this->ended();
    return true;
  }
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
    this->began();
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

  static constexpr std::size_t largestDepth = 32;
  const std::string& File;
  const int& Line;
  const std::size_t Most;
  JsonNode Root;
  std::vector<JsonNode*> Open;
  std::vector<std::unordered_set<std::string>> Keys;
  std::size_t Count = 0;
};
} // namespace dgtk

#endif
