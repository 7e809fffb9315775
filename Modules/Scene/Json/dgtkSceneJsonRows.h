// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneJsonRows_h
#define dgtkSceneJsonRows_h

// Private to Scene: makes rows of the tables of dgtkSceneJson.h.

#include "dgtkSceneJson.h"

#include <array>

namespace dgtk::scenefile
{

// How a member of each type is read.

inline void readInto(const JsonCursor& at, const Range&, std::string& into) { into = at.string(); }
inline void readInto(const JsonCursor& at, const Range&, bool& into) { into = at.boolean(); }
inline void readInto(const JsonCursor& at, const Range& range, int& into)
{
  into = static_cast<int>(at.wholeNumber(range));
}
inline void readInto(const JsonCursor& at, const Range& range, double& into) { into = at.number(range); }
inline void readInto(const JsonCursor& at, const Range& range, Eigen::Vector3d& into) { into = at.vector(range); }
inline void readInto(const JsonCursor& at, const Range& range, std::array<double, 3>& into)
{
  Eigen::Map<Eigen::Vector3d>(into.data()) = at.vector(range);
}
inline void readInto(const JsonCursor& at, const Range& range, std::array<int, 3>& into)
{
  at.listSize(into.size());
  for (std::size_t i = 0; i < into.size(); ++i)
  {
    into[i] = static_cast<int>(at.element(i).wholeNumber(range));
  }
}
inline void readInto(const JsonCursor& at, const Range& range, std::vector<double>& into)
{
  into.clear();
  for (const JsonCursor& item : at.items())
  {
    into.push_back(item.number(range));
  }
}
template <typename T>
inline void readInto(const JsonCursor& at, const Range& range, Track<T>& into)
{
  readTrack(at, range, into);
}
template <typename T>
inline void readInto(const JsonCursor& at, const Range& range, std::optional<T>& into)
{
  into.emplace();
  readInto(at, range, *into);
}

// How it is written, and when it is its default.

template <typename List>
inline JsonNode writeNumbers(const List& values)
{
  JsonNode list(JsonNode::Type::Array);
  for (const double value : values)
  {
    list.children.push_back(JsonNode::of(value));
  }
  return list;
}
inline JsonNode writeValue(const std::array<double, 3>& v) { return writeNumbers(v); }
inline JsonNode writeValue(const std::array<int, 3>& v) { return writeNumbers(v); }
inline JsonNode writeValue(const std::array<int, 2>& v) { return writeNumbers(v); }
inline JsonNode writeValue(const std::vector<double>& v) { return writeNumbers(v); }
template <typename T>
inline JsonNode writeValue(const Track<T>& track)
{
  return writeTrack(track);
}
template <typename T>
inline void add(JsonNode& object, const char* key, const T& value, const T& usual)
{
  if (!(value == usual))
  {
    object.add(key, writeValue(value));
  }
}
inline void add(JsonNode& object, const char* key, const std::string& value, const std::string& usual)
{
  if (value != usual)
  {
    object.add(key, JsonNode::of(value));
  }
}
inline void add(JsonNode& object, const char* key, bool value, bool usual)
{
  if (value != usual)
  {
    object.add(key, JsonNode::of(value));
  }
}
template <typename T>
inline void add(JsonNode& object, const char* key, const Track<T>& track, const Track<T>& usual)
{
  if (!isConstant(track, usual.value))
  {
    object.add(key, writeTrack(track));
  }
}
template <typename T>
inline void add(JsonNode& object, const char* key, const std::optional<T>& value, const std::optional<T>&)
{
  if (value)
  {
    object.add(key, writeValue(*value));
  }
}

template <typename C, typename M>
C classOf(M C::*);

/// The row of a plain member; its default is that of the struct.
template <auto Member, const Range& Allowed = rules::none>
auto row(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key, [](const JsonCursor& at, T& into) { readInto(at, Allowed, into.*Member); },
    [](const T& from, const char* name, JsonNode& object)
    {
      static const T usual;
      add(object, name, from.*Member, usual.*Member);
    } };
}

/// The row of a text that is never empty and always written.
template <auto Member>
auto textRow(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key, [](const JsonCursor& at, T& into) { into.*Member = at.string(false); },
    [](const T& from, const char* name, JsonNode& object) { object.add(name, JsonNode::of(from.*Member)); } };
}

/// The row of one of several words; the first is the default.
template <auto Member, const std::vector<std::string>& (*Words)()>
auto wordRow(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key,
    [](const JsonCursor& at, T& into)
    { into.*Member = static_cast<std::decay_t<decltype(into.*Member)>>(at.oneOf(Words())); },
    [](const T& from, const char* name, JsonNode& object)
    {
      const auto index = static_cast<std::size_t>(from.*Member);
      if (index != 0)
      {
        object.add(name, JsonNode::of(Words()[index]));
      }
    } };
}

/// The row of a struct that has a table of its own.
template <auto Member, auto Fields>
auto structRow(const char* key)
{
  using T = decltype(classOf(Member));
  return JsonField<T>{ key, [](const JsonCursor& at, T& into) { readFields(at, Fields(), into.*Member); },
    [](const T& from, const char* name, JsonNode& object)
    {
      JsonNode child = writeFields(from.*Member, Fields());
      if (!child.children.empty())
      {
        object.add(name, std::move(child));
      }
    } };
}

} // namespace dgtk::scenefile

#endif
