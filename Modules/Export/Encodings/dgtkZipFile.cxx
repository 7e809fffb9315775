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
constexpr std::uint32_t directoryEnd = 0x06054b50;
constexpr std::uint16_t version = 20;
constexpr std::uint16_t date = (1 << 5) + 1; ///< 1980-01-01
} // namespace

ZipFile::ZipFile(ExportSink& sink, const std::string& name)
  : File(sink.open(name))
{
}

/// What a member's two headers share: version, flags, method (stored), time, date, sum, sizes, lengths of names.
std::string ZipFile::described() const
{
  std::string text;
  putLittle(text, version);
  putLittle(text, std::uint16_t(0));
  putLittle(text, std::uint16_t(0));
  putLittle(text, std::uint16_t(0));
  putLittle(text, date);
  putLittle(text, this->Sum);
  putLittle(text, std::uint32_t(this->Size));
  putLittle(text, std::uint32_t(this->Size));
  putLittle(text, std::uint16_t(this->Member.size()));
  putLittle(text, std::uint16_t(0));
  return text;
}

void ZipFile::begin(const std::string& name, std::uint64_t bytes)
{
  constexpr std::uint64_t most = 0xffffffff;
  this->Member = name;
  this->Size = bytes;
  this->Sum = 0;
  this->Start = this->At;
  std::string head;
  putLittle(head, local);
  head += this->described() + name;
  this->At += head.size() + bytes;
  if (this->At > most)
  {
    throw UsageError(name + ": the archive would have more than 4 GiB");
  }
  this->File->write(head);
}

void ZipFile::put(const void* data, std::size_t bytes)
{
  if (bytes == 0)
  {
    return; // of no data the sum would begin anew
  }
  this->File->write(data, bytes);
  this->Sum = static_cast<std::uint32_t>(::crc32_z(this->Sum, static_cast<const unsigned char*>(data), bytes));
}

/// The sum is known now, which stands before the bytes.
void ZipFile::end()
{
  const std::string same = this->described();
  this->File->rewrite(this->Start + sizeof(local), same);
  putLittle(this->Directory, central);
  putLittle(this->Directory, version);
  this->Directory += same;
  for (int i = 0; i < 3; ++i)
  {
    putLittle(this->Directory, std::uint16_t(0)); // comment, disk, internal attributes
  }
  putLittle(this->Directory, std::uint32_t(0));
  putLittle(this->Directory, std::uint32_t(this->Start));
  this->Directory += this->Member;
  ++this->Members;
}

void ZipFile::finish()
{
  std::string tail = this->Directory;
  putLittle(tail, directoryEnd);
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
