// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPickle.h"

#include "dgtkError.h"

#include <algorithm>
#include <utility>

namespace dgtk
{

namespace
{
/// What stands on the machine's stack.
struct Value
{
  enum class Kind
  {
    Mark,
    Text, ///< also names of functions and classes
    Number,
    None,
    Truth,
    Bytes,
    Tuple,
    Made, ///< what a function gave for a tuple: name, arguments and, once built, the state
    Dictionary
  };
  Kind kind = Kind::None;
  std::string text = {};
  std::int64_t number = 0;
  std::size_t begin = 0;
  std::size_t size = 0;
  std::vector<Value> items = {};
  int depth = 0; ///< of what is in it
};
using Kind = Value::Kind;

class Machine
{
public:
  Machine(const std::string& path, const std::string& bytes)
    : Path(path)
    , Bytes(bytes)
  {
  }

  Value run()
  {
    while (true)
    {
      const char code = this->Bytes.at(this->take(1));
      if (code == '.')
      {
        return this->pop();
      }
      this->step(static_cast<unsigned char>(code));
    }
  }

private:
  [[noreturn]] void fail() const { throw InputError(this->Path, "is no pickle of videos"); }

  std::size_t take(std::size_t count)
  {
    if (count > this->Bytes.size() - this->At)
    {
      this->fail();
    }
    this->At += count;
    return this->At - count;
  }
  std::uint64_t little(std::size_t count)
  {
    const std::size_t begin = this->take(count);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      value |= std::uint64_t(static_cast<unsigned char>(this->Bytes[begin + i])) << (8 * i);
    }
    return value;
  }
  std::string line()
  {
    const std::size_t end = this->Bytes.find('\n', this->At);
    const std::size_t begin = this->take(end == std::string::npos ? this->Bytes.size() : end + 1 - this->At);
    return this->Bytes.substr(begin, this->At - begin - 1);
  }

  void push(Value value) { this->Stack.push_back(std::move(value)); }
  Value pop()
  {
    if (this->Stack.empty())
    {
      this->fail();
    }
    Value value = std::move(this->Stack.back());
    this->Stack.pop_back();
    return value;
  }
  std::vector<Value> popTo(std::size_t begin)
  {
    if (begin > this->Stack.size())
    {
      this->fail();
    }
    std::vector<Value> values(
      std::make_move_iterator(this->Stack.begin() + std::ptrdiff_t(begin)), std::make_move_iterator(this->Stack.end()));
    this->Stack.resize(begin);
    return values;
  }
  std::vector<Value> popToMark()
  {
    std::size_t begin = this->Stack.size();
    while (begin > 0 && this->Stack[begin - 1].kind != Kind::Mark)
    {
      --begin;
    }
    std::vector<Value> values = this->popTo(begin);
    this->pop();
    return values;
  }
  Value& top()
  {
    if (this->Stack.empty())
    {
      this->fail();
    }
    return this->Stack.back();
  }

  void pushBytes(std::uint64_t count)
  {
    Value value{ Kind::Bytes };
    value.size = static_cast<std::size_t>(count);
    value.begin = this->take(value.size);
    this->push(value);
  }
  void pushNumber(std::int64_t number)
  {
    Value value{ Kind::Number };
    value.number = number;
    this->push(value);
  }
  /// Of these files nothing is nested as deep, and what is destroys itself recursively.
  void put(Value item, Value& into) const
  {
    constexpr int deepest = 16;
    into.depth = std::max(into.depth, item.depth + 1);
    into.items.push_back(std::move(item));
    if (into.depth > deepest)
    {
      this->fail();
    }
  }
  void put(std::vector<Value> items, Value& into) const
  {
    for (Value& item : items)
    {
      this->put(std::move(item), into);
    }
  }
  void pushTuple(std::vector<Value> items)
  {
    Value value{ Kind::Tuple };
    this->put(std::move(items), value);
    this->push(std::move(value));
  }

  void step(unsigned char code)
  {
    switch (code)
    {
      case 0x80: // protocol
        this->take(1);
        return;
      case '}':
        return this->push(Value{ Kind::Dictionary });
      case '(':
        return this->push(Value{ Kind::Mark });
      case 'N':
        return this->push(Value{ Kind::None });
      case 0x88:
      case 0x89:
        return this->push(Value{ Kind::Truth });
      case 'K':
        return this->pushNumber(std::int64_t(this->little(1)));
      case 'J':
        return this->pushNumber(static_cast<std::int32_t>(this->little(4)));
      case 'X':
      {
        const auto size = static_cast<std::size_t>(this->little(4));
        return this->push(Value{ Kind::Text, this->Bytes.substr(this->take(size), size) });
      }
      case 'c':
      {
        const std::string module = this->line();
        return this->push(Value{ Kind::Text, module + '.' + this->line() });
      }
      case 'C':
        return this->pushBytes(this->little(1));
      case 0x8e:
        return this->pushBytes(this->little(8));
      case 't':
        return this->pushTuple(this->popToMark());
      case 0x85:
      case 0x87:
        return this->pushTuple(
          this->popTo(this->Stack.size() - std::min<std::size_t>(this->Stack.size(), code - 0x84U)));
      case 'R':
      {
        Value made{ Kind::Made };
        this->put(this->pop(), made);
        made.text = this->pop().text;
        return this->push(std::move(made));
      }
      case 'b':
      {
        Value state = this->pop();
        return this->put(std::move(state), this->top());
      }
      case 'u':
      {
        std::vector<Value> entries = this->popToMark();
        return this->put(std::move(entries), this->top());
      }
      default:
        this->fail();
    }
  }

  const std::string& Path;
  const std::string& Bytes;
  std::size_t At = 0;
  std::vector<Value> Stack;
};

/// _reconstruct(ndarray, (0,), b'b') with the state (1, shape, dtype, False, bytes).
PickledArray arrayOf(const std::string& path, const Value& value)
{
  const bool made = value.kind == Kind::Made && value.text == "numpy.core.multiarray._reconstruct" &&
                    value.items.size() == 2 && value.items[1].items.size() == 5;
  const std::vector<Value> state = made ? value.items[1].items : std::vector<Value>();
  if (!made || state[1].kind != Kind::Tuple || state[2].text != "numpy.dtype" || state[2].items.size() != 2 ||
      state[2].items[0].items.empty() || state[4].kind != Kind::Bytes)
  {
    throw InputError(path, "has an entry that is no array");
  }
  PickledArray array;
  array.type = state[2].items[0].items[0].text;
  array.begin = state[4].begin;
  array.bytes = state[4].size;
  std::uint64_t values = array.type.empty() ? 0 : std::uint64_t(array.type.back() - '0');
  for (const Value& size : state[1].items)
  {
    array.shape.push_back(std::uint64_t(size.number));
    values *= array.shape.back();
  }
  if (values != array.bytes)
  {
    throw InputError(path, "has an array that is not as long as its shape says");
  }
  return array;
}
} // namespace

PickledVideos readPickledVideos(const std::string& path, const std::string& bytes)
{
  const Value all = Machine(path, bytes).run();
  PickledVideos videos;
  for (std::size_t i = 0; i + 1 < all.items.size(); i += 2)
  {
    std::map<std::string, PickledArray>& video = videos[all.items[i].text];
    const std::vector<Value>& entries = all.items[i + 1].items;
    for (std::size_t k = 0; k + 1 < entries.size(); k += 2)
    {
      video[entries[k].text] = arrayOf(path, entries[k + 1]);
    }
  }
  return videos;
}

} // namespace dgtk
