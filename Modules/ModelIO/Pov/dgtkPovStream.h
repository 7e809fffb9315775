// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovStream_h
#define dgtkPovStream_h

#include "dgtkPovTokenizer.h"

#include <functional>
#include <utility>

namespace dgtk
{

/// The tokens of a scene, with one of look-ahead. Whoever follows directives (#declare, #if, ...) is called on the way
/// and reads what belongs to them, so that nobody else meets one.
class PovStream
{
public:
  using Follow = std::function<void(const PovToken& directive)>;
  class Level;

  explicit PovStream(const std::string& path)
    : Files(path)
  {
  }
  void setFollow(Follow follow) { this->Directive = std::move(follow); }
  PovTokenizer& files() { return this->Files; }
  const PovTokenizer& files() const { return this->Files; }

  const PovToken& peek();
  PovToken take();
  /// Takes the next token when it is that symbol or word.
  bool accept(char symbol) { return this->peek().is(symbol) && this->drop(); }
  bool accept(const char* word) { return this->peek().is(word) && this->drop(); }
  void expect(char symbol, const char* where);
  /// Whether the block goes on; its `close` is taken.
  bool goesOn(char close, const char* where);

  /// Skips a balanced block, which comes next; `see` is shown each of its tokens behind the first.
  void skip(
    char open, char close, const std::string& what = "block", const std::function<void(const PovToken&)>& see = {});
  /// The same with braces, when there are some.
  void skipBlock() { this->skipGroup("{"); }
  /// The same with one of these; false when none comes.
  bool skipGroup(const std::string& opening = "([{");
  /// Skips to the end of a block of braces that is open.
  void skipRest(const char* where);
  /// Reads the value of a declaration: a directive behind it waits, so that it sees the declared name.
  void readValue(const std::function<void()>& read);
  /// The next token as it is written, directives too.
  PovToken raw();
  /// Skips the rest of the line of a directive.
  void skipLine(const PovPlace& place);

  [[noreturn]] void fail(const PovPlace& place, const std::string& what, const std::string& expected = {},
    const std::string& found = {}) const
  {
    this->Files.fail(place, what, expected, found);
  }
  [[noreturn]] void failAt(const PovToken& token, const std::string& what, const std::string& expected) const;

private:
  bool drop();

  PovTokenizer Files;
  Follow Directive;
  PovToken Pending; ///< given back by raw() first
  bool HasPending = false;
  PovToken Look;
  bool HasLook = false;
  int Depth = 0;
  int Nesting = 0;  ///< open braces and parentheses
  int DeferAt = -1; ///< a directive at this nesting ends a value, and has to wait for it
};

/// Depth of nesting; refuses what would overflow the stack.
class PovStream::Level
{
public:
  explicit Level(PovStream& stream);
  ~Level() { --this->Stream.Depth; }
  Level(const Level&) = delete;

private:
  PovStream& Stream;
};

} // namespace dgtk

#endif
