// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkZipFile.h"

#include "dgtkError.h"
#include "dgtkLayerFile.h"

#include <zlib.h>

namespace dgtk
{

namespace
{
constexpr std::uint32_t local = 0x04034b50;
constexpr std::uint32_t central = 0x02014b50;
constexpr std::uint32_t end = 0x06054b50;
constexpr std::uint16_t version = 20;
constexpr std::uint16_t date = (1 << 5) + 1; ///< 1980-01-01

/// What a member's two headers share: version, flags, method (stored), time, date, sum, sizes, lengths of names.
std::string described(const std::string& name, const std::string& bytes)
{
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  std::string text;
  putLittle(text, version);
  putLittle(text, std::uint16_t(0));
  putLittle(text, std::uint16_t(0));
  putLittle(text, std::uint16_t(0));
  putLittle(text, date);
  putLittle(text, std::uint32_t(::crc32_z(0, data, bytes.size())));
  putLittle(text, std::uint32_t(bytes.size()));
  putLittle(text, std::uint32_t(bytes.size()));
  putLittle(text, std::uint16_t(name.size()));
  putLittle(text, std::uint16_t(0));
  return text;
}
} // namespace

ZipFile::ZipFile(ExportSink& sink, const std::string& name)
  : File(sink.open(name))
{
}

void ZipFile::add(const std::string& name, const std::string& bytes)
{
  constexpr std::uint64_t most = 0xffffffff;
  std::string head;
  const std::string same = described(name, bytes);
  putLittle(head, local);
  head += same + name;
  if (this->At + head.size() + bytes.size() > most)
  {
    throw UsageError(name + ": the archive would have more than 4 GiB");
  }
  putLittle(this->Directory, central);
  putLittle(this->Directory, version);
  this->Directory += same;
  for (int i = 0; i < 3; ++i)
  {
    putLittle(this->Directory, std::uint16_t(0)); // comment, disk, internal attributes
  }
  putLittle(this->Directory, std::uint32_t(0));
  putLittle(this->Directory, std::uint32_t(this->At));
  this->Directory += name;
  this->File->write(head);
  this->File->write(bytes);
  this->At += head.size() + bytes.size();
  ++this->Members;
}

void ZipFile::finish()
{
  std::string tail = this->Directory;
  putLittle(tail, end);
  putLittle(tail, std::uint32_t(0)); // disks
  putLittle(tail, this->Members);
  putLittle(tail, this->Members);
  putLittle(tail, std::uint32_t(this->Directory.size()));
  putLittle(tail, std::uint32_t(this->At));
  putLittle(tail, std::uint16_t(0));
  this->File->write(tail);
  this->File->finish();
}

} // namespace dgtk
