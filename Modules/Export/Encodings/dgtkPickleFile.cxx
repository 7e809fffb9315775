// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPickleFile.h"

#include "dgtkLayerFile.h"
#include "dgtkUtf8.h"

namespace dgtk
{

// Opcodes are those of Python's Lib/pickletools.py.
namespace
{
const std::string beginning("\x80\x04}(", 4); // protocol 4, an empty dictionary, its first entry
const std::string emptyArray("cnumpy.core.multiarray\n_reconstruct\ncnumpy\nndarray\nK\0\x85"
                             "C\x01"
                             "b\x87R(K\x01(",
  63);

std::string integer(std::int32_t value)
{
  std::string bytes = "J";
  putLittle(bytes, value);
  return bytes;
}

std::string unicode(const std::string& utf8)
{
  std::string bytes = "X";
  putLittle(bytes, std::uint32_t(utf8.size()));
  return bytes + utf8;
}

/// dtype(type, False, True) with its state: byte order and nothing else.
std::string typeOf(const std::string& type)
{
  const std::string order = type.back() == '1' ? "|" : "<";
  return "cnumpy\ndtype\n(" + unicode(type) + "\x89\x88tR(" + std::string("K\x03") + unicode(order) + "NNN" +
         integer(-1) + integer(-1) + std::string("K\0tb", 4);
}
} // namespace

PickleFile::PickleFile(ExportSink& sink, const std::string& name)
  : File(sink.open(name))
{
  this->File->write(beginning);
}

void PickleFile::text(const std::string& utf8) { this->File->write(unicode(utf8)); }

void PickleFile::beginDictionary(const std::string& key)
{
  this->text(utf8FromBytes(key));
  this->File->write(std::string("}("));
}

void PickleFile::endDictionary() { this->File->write(std::string("u")); }

void PickleFile::beginArray(const std::string& key, const std::string& type, const std::vector<std::uint64_t>& shape)
{
  this->text(key);
  std::string head = emptyArray;
  std::uint64_t bytes = std::uint64_t(type.back() - '0');
  for (const std::uint64_t size : shape)
  {
    head += integer(static_cast<std::int32_t>(size));
    bytes *= size;
  }
  head += 't' + typeOf(type) + '\x89' + '\x8e'; // not in Fortran's order; bytes
  putLittle(head, bytes);
  this->File->write(head);
}

void PickleFile::add(const void* data, std::size_t bytes) { this->File->write(data, bytes); }

void PickleFile::endArray() { this->File->write(std::string("tb")); }

void PickleFile::finish()
{
  this->File->write(std::string("u."));
  this->File->finish();
}

} // namespace dgtk
