// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJsonPieces.h"

#include "dgtkFolder.h"
#include "dgtkJsonTree.h"

#include <cerrno>
#include <cstring>
#include <iterator>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr std::size_t mostValues = 10'000'000;

FileDescriptor opened(const std::string& path)
{
  // O_NONBLOCK: opening a named pipe must not wait for its other end
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat info = {};
  if (!file || ::fstat(file.number(), &info) != 0)
  {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (!S_ISREG(info.st_mode))
  {
    throw InputError(path, "cannot be read", "a file", S_ISDIR(info.st_mode) ? "a directory" : "a pipe or device");
  }
  return file;
}

std::size_t readAt(
  const std::string& path, const FileDescriptor& file, char* to, std::size_t bytes, std::uint64_t offset)
{
  std::size_t done = 0;
  while (done < bytes)
  {
    const ssize_t got = ::pread(file.number(), to + done, bytes - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno != EINTR)
    {
      throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
    }
    if (got == 0)
    {
      break;
    }
    done += got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  return done;
}

/// Characters of a file, a block at a time in memory.
class Characters
{
public:
  explicit Characters(const std::string& path)
    : Path(path)
    , File(opened(path))
    , Block(blockBytes, '\0')
  {
    this->fill();
  }
  bool done() const { return this->At == this->Filled; }
  const char& now() const { return this->Block[this->At]; }
  void next()
  {
    this->Line += this->AfterLine;
    this->AfterLine = this->now() == '\n';
    if (++this->At == this->Filled)
    {
      this->fill();
    }
  }
  std::uint64_t offset() const { return this->Before + this->At; } ///< of the next character
  const int& line() const { return this->Line; }                   ///< of the last one

private:
  void fill()
  {
    this->Before += this->Filled;
    this->At = 0;
    this->Filled = readAt(this->Path, this->File, this->Block.data(), this->Block.size(), this->Before);
  }
  static constexpr std::size_t blockBytes = std::size_t(1) << 16;
  const std::string& Path;
  FileDescriptor File;
  std::string Block;
  std::size_t At = 0;
  std::size_t Filled = 0;
  std::uint64_t Before = 0;
  int Line = 1;
  bool AfterLine = false;
};

/// The parser's way through characters.
class CharacterIterator
{
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  explicit CharacterIterator(Characters* characters = nullptr)
    : From(characters)
  {
  }
  reference operator*() const { return withoutEnd(this->From->now()); }
  CharacterIterator& operator++()
  {
    this->From->next();
    return *this;
  }
  bool operator==(const CharacterIterator& o) const { return this->done() == o.done(); }
  bool operator!=(const CharacterIterator& o) const { return !(*this == o); }

private:
  bool done() const { return !this->From || this->From->done(); }
  Characters* From;
};

/// Hands on the elements of long lists.
class PieceBuilder : public JsonTreeBuilder
{
public:
  PieceBuilder(const std::string& file, const Characters& from, const std::vector<JsonLongList>& lists)
    : JsonTreeBuilder(file, from.line(), mostValues)
    , From(from)
    , Lists(lists)
  {
  }

private:
  bool inList() { return this->depth() == 2 && this->holder().type == JsonNode::Type::Array && this->rootIsObject(); }
  void began() override
  {
    if (this->inList())
    {
      this->Begin = this->From.offset() - 1;
    }
  }
  void ended() override
  {
    if (!this->inList())
    {
      return;
    }
    const std::string& key = this->rootKey();
    for (const JsonLongList& list : this->Lists)
    {
      if (list.key == key)
      {
        this->Number = key == this->Key ? this->Number + 1 : 0;
        this->Key = key;
        const JsonDocument piece{ this->takeLast(), this->file(), key + '[' + std::to_string(this->Number) + ']' };
        list.visit({ JsonCursor(piece), this->Begin, this->From.offset() });
        return;
      }
    }
  }

  const Characters& From;
  const std::vector<JsonLongList>& Lists;
  std::uint64_t Begin = 0;
  std::string Key; ///< of the list that is read
  std::size_t Number = 0;
};
} // namespace

JsonDocument readJsonPieces(const std::string& file, const std::vector<JsonLongList>& lists)
{
  Characters characters(file);
  PieceBuilder builder(file, characters, lists);
  nlohmann::json::sax_parse(
    CharacterIterator(&characters), CharacterIterator(), &builder, nlohmann::json::input_format_t::json, true, true);
  return { builder.take(), file };
}

JsonDocument readJsonPieces(const std::string& file, std::uint64_t begin, std::uint64_t end, const std::string& label)
{
  std::string text(static_cast<std::size_t>(end - begin), '\0');
  text.resize(readAt(file, opened(file), text.data(), text.size(), begin));
  JsonDocument document = parseJson(file, '[' + text + ']');
  document.label = label;
  return document;
}

} // namespace dgtk
