// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHdf5Contents.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include <zlib.h>

// HDF5 File Format Specification, version 2.0 (docs.hdfgroup.org): II.A, III.A.1, III.B to III.D, IV.A.1.a, IV.A.2.

namespace dgtk
{

namespace
{
/// Bytes of the file, looked at with care.
class Hdf5Bytes
{
public:
  Hdf5Bytes(const std::string& path, std::string data)
    : Path(path)
    , Data(std::move(data))
  {
  }
  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const
  {
    throw InputError(this->Path, "at byte " + std::to_string(at) + ": " + what);
  }
  const char* at(std::uint64_t offset, std::uint64_t count) const
  {
    if (offset > this->Data.size() || count > this->Data.size() - offset)
    {
      this->fail(offset, "the file ends");
    }
    return this->Data.data() + offset;
  }
  std::uint64_t number(std::uint64_t offset, std::size_t count) const
  {
    std::uint64_t value = 0;
    std::memcpy(&value, this->at(offset, count), count);
    return value;
  }
  std::string text(std::uint64_t offset) const
  {
    const char* begin = this->at(offset, 1);
    return { begin, ::strnlen(begin, this->Data.size() - offset) };
  }
  void expect(std::uint64_t offset, const std::string& signature) const
  {
    if (std::string(this->at(offset, signature.size()), signature.size()) != signature)
    {
      this->fail(offset, "expected " + signature.substr(0, 4));
    }
  }
  std::uint64_t size() const { return this->Data.size(); }

private:
  std::string Path;
  std::string Data;
};

/// Calls visit(type, offset, size) for the messages of a header of version 1 in one piece.
void forMessages(const Hdf5Bytes& file, std::uint64_t at,
  const std::function<void(std::uint64_t, std::uint64_t, std::uint64_t)>& visit)
{
  if (file.number(at, 1) != 1)
  {
    file.fail(at, "is no header of version 1");
  }
  const std::uint64_t count = file.number(at + 2, 2);
  std::uint64_t message = at + 16;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t size = file.number(message + 2, 2);
    visit(file.number(message, 2), message + 8, size);
    message += 8 + size;
  }
  if (message != at + 16 + file.number(at + 8, 4))
  {
    file.fail(at, "the header's messages are not as long as it says");
  }
}

struct Layout
{
  std::uint64_t kind = 0; ///< 1 contiguous, 2 chunks
  std::uint64_t address = 0;
  std::uint64_t bytes = 0;
  std::vector<std::uint64_t> chunk; ///< and the element's bytes
};

class Hdf5Reader
{
public:
  explicit Hdf5Reader(const std::string& path)
    : File(path, readFile(path))
  {
  }

  std::map<std::string, Hdf5Dataset> members()
  {
    this->File.expect(0, "\x89HDF\r\n\x1a\n");
    if (this->File.number(8, 1) != 0 || this->File.number(13, 1) != 8 || this->File.number(14, 1) != 8)
    {
      this->File.fail(8, "is no superblock of version 0 with addresses of 8 bytes");
    }
    if (this->File.number(40, 8) != this->File.size())
    {
      this->File.fail(40, "the file is not as long as it says");
    }
    std::uint64_t tree = 0;
    std::uint64_t heap = 0;
    forMessages(this->File, this->File.number(64, 8),
      [&](std::uint64_t type, std::uint64_t at, std::uint64_t)
      {
        tree = type == 0x11 ? this->File.number(at, 8) : tree;
        heap = type == 0x11 ? this->File.number(at + 8, 8) : heap;
      });
    this->File.expect(heap, "HEAP");
    this->Names = this->File.number(heap + 24, 8);
    this->group(tree);
    return this->Found;
  }

private:
  /// How many entries the one node of a tree has.
  std::uint64_t entriesOf(std::uint64_t tree) const
  {
    this->File.expect(tree, "TREE");
    if (this->File.number(tree + 5, 1) != 0)
    {
      this->File.fail(tree, "is a tree of several nodes");
    }
    return this->File.number(tree + 6, 2);
  }

  void group(std::uint64_t tree)
  {
    const std::uint64_t entries = this->entriesOf(tree);
    for (std::uint64_t i = 0; i < entries; ++i)
    {
      this->symbols(this->File.number(tree + 32 + 16 * i, 8));
    }
  }

  void symbols(std::uint64_t node)
  {
    this->File.expect(node, "SNOD");
    const std::uint64_t count = this->File.number(node + 6, 2);
    for (std::uint64_t i = 0; i < count; ++i)
    {
      const std::uint64_t entry = node + 8 + 40 * i;
      const std::string name = this->File.text(this->Names + this->File.number(entry, 8));
      if (!this->Last.empty() && name <= this->Last)
      {
        this->File.fail(entry, "names are not in order");
      }
      this->Last = name;
      this->Found[name] = this->dataset(this->File.number(entry + 8, 8));
    }
  }

  Hdf5Dataset dataset(std::uint64_t header)
  {
    Hdf5Dataset found;
    Layout layout;
    forMessages(this->File, header,
      [&](std::uint64_t type, std::uint64_t at, std::uint64_t)
      {
        switch (type)
        {
          case 0x01:
            for (std::uint64_t i = 0; i < this->File.number(at + 1, 1); ++i)
            {
              found.dimensions.push_back(this->File.number(at + 8 + 8 * i, 8));
            }
            break;
          case 0x03:
            this->type(at, found);
            break;
          case 0x08:
            layout = this->layout(at);
            break;
          case 0x0b:
            this->filter(at, found);
            break;
          case 0x0e:
          case 0x12:
            found.hasTime = true;
            break;
          default:
            break;
        }
      });
    const std::uint64_t most = 1032 * this->File.size(); // deflate packs no tighter
    std::uint64_t count = 1;
    for (const std::uint64_t one : found.dimensions)
    {
      if (one == 0 || count > most / one)
      {
        this->File.fail(header, "has no numbers, or more than the file holds");
      }
      count *= one;
    }
    if (found.kind == Hdf5Dataset::Kind::Text)
    {
      found.text = std::string(this->File.at(layout.address, found.bytes), found.bytes);
      return found;
    }
    found.values.resize(count);
    if (layout.kind == 1)
    {
      this->numbers(
        std::string(this->File.at(layout.address, count * found.bytes), count * found.bytes), found, 0, count);
    }
    else
    {
      this->chunks(header, layout, found);
    }
    return found;
  }

  void type(std::uint64_t at, Hdf5Dataset& found) const
  {
    const std::uint64_t kind = this->File.number(at, 1) & 15;
    const std::uint64_t bits = this->File.number(at + 1, 3);
    found.bytes = this->File.number(at + 4, 4);
    const bool wide = found.bytes == 1 || found.bytes == 2 || found.bytes == 4 || found.bytes == 8;
    if (kind > 3 || kind == 2 || (kind < 2 && ((bits & 1) != 0 || !wide)))
    {
      this->File.fail(at, "is a type that is not known here");
    }
    found.kind = kind == 0 ? Hdf5Dataset::Kind::Whole : kind == 1 ? Hdf5Dataset::Kind::Real : Hdf5Dataset::Kind::Text;
    this->Signed = (bits & 8) != 0;
  }

  Layout layout(std::uint64_t at) const
  {
    Layout layout;
    layout.kind = this->File.number(at + 1, 1);
    if (this->File.number(at, 1) != 3 || (layout.kind != 1 && layout.kind != 2))
    {
      this->File.fail(at, "is a layout that is not known here");
    }
    if (layout.kind == 1)
    {
      layout.address = this->File.number(at + 2, 8);
      layout.bytes = this->File.number(at + 10, 8);
      return layout;
    }
    layout.address = this->File.number(at + 3, 8);
    for (std::uint64_t i = 0; i < this->File.number(at + 2, 1); ++i)
    {
      layout.chunk.push_back(this->File.number(at + 11 + 4 * i, 4));
    }
    return layout;
  }

  void filter(std::uint64_t at, Hdf5Dataset& found) const
  {
    if (this->File.number(at, 1) != 1 || this->File.number(at + 1, 1) != 1 || this->File.number(at + 8, 2) != 1)
    {
      this->File.fail(at, "are filters that are not known here");
    }
    found.deflate = static_cast<int>(this->File.number(at + 16 + this->File.number(at + 10, 2), 4));
  }

  void chunks(std::uint64_t header, const Layout& layout, Hdf5Dataset& found)
  {
    if (found.dimensions.empty() || layout.chunk.size() != found.dimensions.size() + 1 ||
        layout.chunk[0] > found.dimensions[0])
    {
      this->File.fail(header, "has chunks that are none of its array");
    }
    const std::uint64_t entries = this->entriesOf(layout.address);
    const std::uint64_t keyBytes = 8 + 8 * layout.chunk.size();
    for (std::uint64_t i = 0; i < entries; ++i)
    {
      const std::uint64_t key = layout.address + 24 + (keyBytes + 8) * i;
      this->chunk(i, key, this->File.number(key + keyBytes, 8), layout, found);
    }
  }

  /// Chunks that hold whole rows, one behind the other, which all of these files have.
  void chunk(
    std::uint64_t place, std::uint64_t key, std::uint64_t address, const Layout& layout, Hdf5Dataset& found) const
  {
    std::uint64_t row = 1;
    for (std::size_t i = 1; i < found.dimensions.size(); ++i)
    {
      row *= found.dimensions[i];
      if (layout.chunk[i] != found.dimensions[i] || this->File.number(key + 8 + 8 * i, 8) != 0)
      {
        this->File.fail(key, "is a chunk of parts of rows");
      }
    }
    const std::uint64_t first = this->File.number(key + 8, 8) * row;
    const std::uint64_t most = layout.chunk[0] * row;
    const std::uint64_t stored = this->File.number(key, 4);
    std::string data(most * found.bytes, '\0');
    uLongf size = data.size();
    const char* packed = this->File.at(address, stored);
    const bool plain = found.deflate < 0;
    if (plain)
    {
      data.assign(packed, stored);
    }
    else if (uncompress(reinterpret_cast<Bytef*>(data.data()), &size, reinterpret_cast<const Bytef*>(packed), stored) !=
             Z_OK)
    {
      this->File.fail(address, "cannot be inflated");
    }
    if ((plain ? stored : std::uint64_t(size)) != most * found.bytes || first != place * most ||
        first >= found.values.size())
    {
      this->File.fail(address, "is a chunk of another size, or elsewhere");
    }
    this->numbers(data, found, first, std::min<std::uint64_t>(most, found.values.size() - first));
  }

  void numbers(const std::string& data, Hdf5Dataset& found, std::uint64_t first, std::uint64_t count) const
  {
    for (std::uint64_t i = 0; i < count; ++i)
    {
      const char* from = data.data() + i * found.bytes;
      double value = 0;
      float real = 0;
      std::int32_t whole = 0;
      if (found.kind == Hdf5Dataset::Kind::Real && found.bytes == 4)
      {
        std::memcpy(&real, from, 4);
        value = double(real);
      }
      else if (found.kind == Hdf5Dataset::Kind::Whole && found.bytes == 4 && this->Signed)
      {
        std::memcpy(&whole, from, 4);
        value = whole;
      }
      else if (found.kind == Hdf5Dataset::Kind::Whole && found.bytes == 1 && !this->Signed)
      {
        value = static_cast<unsigned char>(*from);
      }
      else
      {
        this->File.fail(0, "has numbers that are not known here");
      }
      found.values[first + i] = value;
    }
  }

  Hdf5Bytes File;
  std::uint64_t Names = 0;
  std::string Last;
  mutable bool Signed = false; ///< of the type read last
  std::map<std::string, Hdf5Dataset> Found;
};
} // namespace

std::map<std::string, Hdf5Dataset> readHdf5(const std::string& path) { return Hdf5Reader(path).members(); }

} // namespace dgtk
