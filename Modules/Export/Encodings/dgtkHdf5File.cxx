// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHdf5File.h"

#include "dgtkLayerFile.h"

#include <algorithm>
#include <stdexcept>

#include <zlib.h>

// HDF5 File Format Specification, version 2.0 (docs.hdfgroup.org).

namespace dgtk
{

namespace
{
constexpr std::uint64_t undefined = ~std::uint64_t(0);
constexpr std::size_t groupLeafK = 16;     ///< 2 K members in the one node of symbols
constexpr std::size_t groupInternalK = 16; ///< the library's own
constexpr std::size_t chunkK = 32;         ///< what superblock 0 means: 2 K chunks in the one node of a tree
constexpr std::size_t entryBytes = 40;
constexpr std::uint64_t usualChunk = 65536; ///< bytes, at least, where the array has as many

using Word = std::uint64_t;
using Half = std::uint32_t;
using Quarter = std::uint16_t;

void pad(std::string& bytes, std::size_t to) { bytes.append((to - bytes.size() % to) % to, '\0'); }

std::size_t bytesOfType(Hdf5File::Type type) { return type == Hdf5File::Type::UInt8 ? 1 : 4; }

/// A message of an object header.
std::string message(Quarter type, std::string data)
{
  pad(data, 8);
  std::string bytes;
  putLittle(bytes, type);
  putLittle(bytes, static_cast<Quarter>(data.size()));
  putLittle(bytes, Half(0)); // no flags
  return bytes + data;
}

std::string objectHeader(const std::vector<std::string>& messages)
{
  std::string all;
  for (const std::string& one : messages)
  {
    all += one;
  }
  std::string bytes("\1\0", 2);
  putLittle(bytes, static_cast<Quarter>(messages.size()));
  putLittle(bytes, Half(1)); // references
  putLittle(bytes, static_cast<Half>(all.size()));
  putLittle(bytes, Half(0));
  return bytes + all;
}

std::string dataspace(const std::vector<std::uint64_t>& dimensions)
{
  std::string bytes("\1", 1);
  bytes += static_cast<char>(dimensions.size());
  bytes.append(6, '\0');
  for (const Word one : dimensions)
  {
    putLittle(bytes, one);
  }
  return message(0x0001, bytes);
}

std::string textType(std::size_t size)
{
  std::string bytes("\x13\x01\0\0", 4); // version 1, a string, filled with zeros
  putLittle(bytes, static_cast<Half>(size));
  return message(0x0003, bytes);
}

std::string numberType(Hdf5File::Type type)
{
  const std::size_t size = bytesOfType(type);
  const bool real = type == Hdf5File::Type::Float32;
  std::string bytes(1, real ? '\x11' : '\x10');
  bytes += real ? std::string("\x20\x1f\0", 3) : std::string(type == Hdf5File::Type::Int32 ? "\x08\0\0" : "\0\0\0", 3);
  putLittle(bytes, static_cast<Half>(size));
  putLittle(bytes, Quarter(0));
  putLittle(bytes, static_cast<Quarter>(8 * size));
  if (real)
  {
    bytes += std::string("\x17\x08\0\x17", 4); // exponent at 23, 8 bits; mantissa at 0, 23 bits
    putLittle(bytes, Half(127));
  }
  return message(0x0003, bytes);
}

/// Zeros where nothing was written.
std::string fillValue(char allocation) { return message(0x0005, { '\2', allocation, '\2', '\1', 0, 0, 0, 0 }); }

std::string deflate(const std::string& data, int level)
{
  uLongf size = compressBound(data.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
        data.size(), level) != Z_OK)
  {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return packed;
}

std::string nodeHead(char type, std::size_t entries)
{
  std::string bytes = "TREE";
  bytes += type;
  bytes += '\0'; // a leaf
  putLittle(bytes, static_cast<Quarter>(entries));
  putLittle(bytes, undefined);
  putLittle(bytes, undefined);
  return bytes;
}

struct Placed
{
  Word heap = 0;   ///< of its name
  Word header = 0; ///< address
};

/// The tree of a group, its heap and its symbols; `at`: where they begin.
std::string groupOf(const std::vector<std::string>& names, const std::vector<Placed>& placed, Word at)
{
  const std::size_t treeBytes = 24 + (2 * groupInternalK + 1) * 8 + 2 * groupInternalK * 8;
  std::string heap(8, '\0');
  for (const std::string& name : names)
  {
    heap += name + '\0';
    pad(heap, 8);
  }
  const Word heapAt = at + treeBytes;
  const Word symbolsAt = heapAt + 32 + heap.size();
  std::string bytes = nodeHead('\0', 1);
  putLittle(bytes, Word(0));
  putLittle(bytes, symbolsAt);
  putLittle(bytes, placed.empty() ? Word(0) : placed.back().heap);
  bytes.resize(treeBytes);
  bytes += std::string("HEAP\0\0\0\0", 8);
  putLittle(bytes, Word(heap.size()));
  putLittle(bytes, Word(1)); // nothing is free
  putLittle(bytes, heapAt + 32);
  bytes += heap;
  bytes += std::string("SNOD\1\0", 6);
  putLittle(bytes, static_cast<Quarter>(placed.size()));
  for (const Placed& one : placed)
  {
    putLittle(bytes, one.heap);
    putLittle(bytes, one.header);
    bytes.append(entryBytes - 16, '\0');
  }
  bytes.resize(symbolsAt - at + 8 + 2 * groupLeafK * entryBytes);
  return bytes;
}

std::string superblock(Word header, Word tree, Word heap, Word end)
{
  std::string bytes("\x89HDF\r\n\x1a\n\0\0\0\0\0\x08\x08\0", 16);
  putLittle(bytes, static_cast<Quarter>(groupLeafK));
  putLittle(bytes, static_cast<Quarter>(groupInternalK));
  putLittle(bytes, Half(0));
  putLittle(bytes, Word(0));
  putLittle(bytes, undefined);
  putLittle(bytes, end);
  putLittle(bytes, undefined);
  putLittle(bytes, Word(0)); // the root's name
  putLittle(bytes, header);
  putLittle(bytes, Half(1)); // tree and heap follow
  putLittle(bytes, Half(0));
  putLittle(bytes, tree);
  putLittle(bytes, heap);
  return bytes;
}
} // namespace

Hdf5File::Hdf5File(int level)
  : Level(level)
{
}

void Hdf5File::add(
  const std::string& name, Type type, const Shape& shape, const std::function<void(int y, void* row)>& fill)
{
  Member member;
  member.name = name;
  member.type = type;
  member.dimensions = { Word(shape.height), Word(shape.width) };
  if (shape.channels > 1)
  {
    member.dimensions.push_back(Word(shape.channels));
  }
  const Word rowBytes = bytesOfType(type) * Word(shape.width) * Word(shape.channels);
  const Word height = Word(shape.height);
  member.chunkRows =
    std::min(height, std::max<Word>((height + 2 * chunkK - 1) / (2 * chunkK), (usualChunk + rowBytes - 1) / rowBytes));
  for (Word begin = 0; begin < height; begin += member.chunkRows)
  {
    std::string chunk(member.chunkRows * rowBytes, '\0'); // the last one reaches beyond the rows
    for (Word y = begin; y < std::min(height, begin + member.chunkRows); ++y)
    {
      fill(static_cast<int>(y), chunk.data() + (y - begin) * rowBytes);
    }
    member.chunks.push_back(deflate(chunk, this->Level));
  }
  this->Members.push_back(std::move(member));
}

void Hdf5File::add(const std::string& name, const std::string& text)
{
  this->Members.push_back({ name, Type::UInt8, {}, 0, { text } });
}

std::string Hdf5File::headerOf(const Member& member, std::uint64_t data) const
{
  if (member.chunkRows == 0)
  {
    std::string layout("\3\1", 2); // contiguous
    putLittle(layout, data);
    putLittle(layout, Word(member.chunks[0].size()));
    return objectHeader({ dataspace({}), textType(member.chunks[0].size()), fillValue('\2'), message(0x0008, layout) });
  }
  std::string layout("\3\2", 2); // chunks
  layout += static_cast<char>(member.dimensions.size() + 1);
  putLittle(layout, data);
  putLittle(layout, static_cast<Half>(member.chunkRows));
  for (std::size_t i = 1; i < member.dimensions.size(); ++i)
  {
    putLittle(layout, static_cast<Half>(member.dimensions[i]));
  }
  putLittle(layout, static_cast<Half>(bytesOfType(member.type)));
  std::string filter("\1\1\0\0\0\0\0\0\1\0\0\0\1\0\1\0", 16); // one: deflate, unnamed, optional, one number
  putLittle(filter, static_cast<Half>(this->Level));
  return objectHeader({ dataspace(member.dimensions), numberType(member.type), fillValue('\3'), message(0x0008, layout),
    message(0x000b, filter) });
}

std::string Hdf5File::treeOf(const Member& member, std::uint64_t data)
{
  const std::size_t keyBytes = 8 + 8 * (member.dimensions.size() + 1);
  std::string bytes = nodeHead('\1', member.chunks.size());
  const auto key = [&](std::size_t chunk, std::size_t size)
  {
    const std::size_t end = bytes.size() + keyBytes;
    putLittle(bytes, static_cast<Half>(size));
    putLittle(bytes, Half(0)); // no filter is left out
    putLittle(bytes, Word(chunk) * member.chunkRows);
    bytes.resize(end);
  };
  for (std::size_t i = 0; i < member.chunks.size(); ++i)
  {
    key(i, member.chunks[i].size());
    putLittle(bytes, data);
    data += (member.chunks[i].size() + 7) / 8 * 8;
  }
  key(member.chunks.size(), 0);
  bytes.resize(24 + (2 * chunkK + 1) * keyBytes + 2 * chunkK * 8);
  return bytes;
}

std::string Hdf5File::bytes() const
{
  std::vector<const Member*> members;
  std::vector<std::string> names;
  for (const Member& member : this->Members)
  {
    members.push_back(&member);
  }
  std::sort(members.begin(), members.end(), [](const Member* a, const Member* b) { return a->name < b->name; });
  std::vector<Placed> placed(members.size());
  Word heap = 8;
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    names.push_back(members[i]->name);
    placed[i].heap = heap;
    heap += (names.back().size() + 8) / 8 * 8;
  }
  if (members.size() > 2 * groupLeafK)
  {
    throw std::logic_error("an HDF5 file of more members than a node has");
  }
  const std::string root = objectHeader({ message(0x0011, std::string(16, '\0')) });
  constexpr Word superblockBytes = 96;
  const Word groupAt = superblockBytes + root.size();
  Word at = groupAt + groupOf(names, placed, groupAt).size();
  std::string rest;
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    const Member& member = *members[i];
    placed[i].header = at + rest.size();
    const Word behind = placed[i].header + this->headerOf(member, 0).size();
    rest += this->headerOf(member, behind);
    rest += member.chunkRows == 0 ? "" : treeOf(member, behind + treeOf(member, 0).size());
    for (const std::string& chunk : member.chunks)
    {
      rest += chunk;
      pad(rest, 8);
    }
  }
  const std::string group = groupOf(names, placed, groupAt);
  const Word treeBytes = 24 + (2 * groupInternalK + 1) * 8 + 2 * groupInternalK * 8;
  std::string table;
  putLittle(table, groupAt);
  putLittle(table, groupAt + treeBytes);
  return superblock(superblockBytes, groupAt, groupAt + treeBytes, at + rest.size()) +
         objectHeader({ message(0x0011, table) }) + group + rest;
}

} // namespace dgtk
