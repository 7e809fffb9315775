// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonValue_h
#define dgtkJsonValue_h

// Private to DatasetIO; for sources only, nlohmann's header is heavy.

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// A value of a document with its place, for messages such as `cameras.json: cameras[3].K: is missing`.
class JsonValue
{
public:
  JsonValue(const std::string& file, const std::string& place, const nlohmann::ordered_json& json)
    : File(file)
    , Place(place)
    , Node(json)
  {
  }

  [[noreturn]] void fail(const std::string& what, const std::string& expected = {}, const std::string& found = {}) const
  {
    throw InputError(this->File, 0, (this->Place.empty() ? what : this->Place + ": " + what), expected, found);
  }
  void require(bool right, const char* expected) const
  {
    if (!right)
    {
      const std::string text = this->Node.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
      this->fail("has the wrong type or value", expected, quoted(text));
    }
  }

  bool isNull() const { return this->Node.is_null(); }
  bool has(const char* key) const { return this->Node.is_object() && this->Node.contains(key); }
  JsonValue operator[](const char* key) const
  {
    this->require(this->Node.is_object(), "an object");
    const std::string place = this->Place.empty() ? key : this->Place + "." + key;
    if (!this->Node.contains(key))
    {
      JsonValue(this->File, place, this->Node).fail("is missing");
    }
    return { this->File, place, this->Node.at(key) };
  }
  std::vector<JsonValue> items() const
  {
    this->require(this->Node.is_array(), "a list");
    std::vector<JsonValue> all;
    for (std::size_t i = 0; i < this->Node.size(); ++i)
    {
      all.emplace_back(this->File, this->Place + "[" + std::to_string(i) + "]", this->Node[i]);
    }
    return all;
  }
  std::vector<std::pair<std::string, std::string>> members() const
  {
    this->require(this->Node.is_object(), "an object");
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& [key, value] : this->Node.items())
    {
      all.emplace_back(bytesFromUtf8(key), JsonValue(this->File, this->Place + "." + key, value).text());
    }
    return all;
  }

  std::string text() const
  {
    this->require(this->Node.is_string(), "a text");
    return bytesFromUtf8(this->Node.get<std::string>());
  }
  double number() const
  {
    this->require(this->Node.is_number(), "a number");
    return this->Node.get<double>();
  }
  /// Infinite when null: JSON has no infinity.
  double range() const { return this->Node.is_null() ? std::numeric_limits<double>::infinity() : this->number(); }
  std::int64_t integer(std::int64_t least, std::int64_t most) const
  {
    const std::string expected = "an integer from " + std::to_string(least) + " to " + std::to_string(most);
    this->require(this->Node.is_number_integer() &&
                    !(this->Node.is_number_unsigned() && this->Node.get<std::uint64_t>() > std::uint64_t(most)),
      expected.c_str());
    const auto value = this->Node.get<std::int64_t>();
    this->require(value >= least && value <= most, expected.c_str());
    return value;
  }
  int smallInteger(int least = 0) const { return int(this->integer(least, std::numeric_limits<int>::max())); }
  std::uint64_t count() const { return std::uint64_t(this->integer(0, std::numeric_limits<std::int64_t>::max())); }
  std::string hash() const
  {
    std::string value = this->text();
    this->require(
      value.size() == 64 && value.find_first_not_of("0123456789abcdef") == std::string::npos, "64 hexadecimal digits");
    return value;
  }
  template <typename M>
  M matrix() const
  {
    M out;
    const std::vector<JsonValue> rows = this->items();
    this->require(rows.size() == std::size_t(out.rows()), "as many rows as the matrix has");
    for (int i = 0; i < out.rows(); ++i)
    {
      if constexpr (M::ColsAtCompileTime == 1)
      {
        out(i) = rows[i].number();
      }
      else
      {
        const std::vector<JsonValue> row = rows[i].items();
        rows[i].require(row.size() == std::size_t(out.cols()), "as many columns as the matrix has");
        for (int j = 0; j < out.cols(); ++j)
        {
          out(i, j) = row[j].number();
        }
      }
    }
    return out;
  }

private:
  std::string File;
  std::string Place;
  const nlohmann::ordered_json& Node;
};

inline nlohmann::ordered_json readJson(const std::string& path)
{
  const std::string text = readFile(path, std::uint64_t(1) << 30);
  try
  {
    return nlohmann::ordered_json::parse(text);
  }
  catch (const nlohmann::ordered_json::parse_error& error)
  {
    const std::size_t position = std::min<std::size_t>(error.byte, text.size());
    const long line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
    throw InputError(path, line, "is not JSON");
  }
  catch (const nlohmann::ordered_json::exception&)
  {
    throw InputError(path, 0, "is not JSON that can be used");
  }
}

} // namespace dgtk

#endif
