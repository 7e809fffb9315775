// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureEnd.h"

#include <algorithm>
#include <utility>

namespace
{
/// Numbers of a file in memory; bytes beyond its end are 0.
struct Numbers
{
  const std::uint8_t* data;
  std::size_t bytes;
  bool highestFirst;

  std::uint64_t at(std::uint64_t where, std::uint64_t size) const
  {
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < size; ++i)
    {
      const std::uint64_t from = where + (this->highestFirst ? i : size - 1 - i);
      value = value << 8 | (from < this->bytes ? this->data[from] : 0);
    }
    return value;
  }
  bool holds(std::uint64_t where, std::uint64_t count) const
  {
    return where <= this->bytes && count <= this->bytes - where;
  }
};

/// "The SGI Image File Format", version 1.00: a header of 512 bytes; then the rows, or where each packed row begins and
/// how long each is.
bool sgiLacksItsEnd(const Numbers& file)
{
  const std::uint64_t dimensions = file.at(4, 2);
  const std::uint64_t height = file.at(8, 2);
  const std::uint64_t rows = (dimensions > 1 ? height : 1) * (dimensions > 2 ? file.at(10, 2) : 1);
  if (file.at(2, 1) == 0)
  {
    return !file.holds(512, rows * file.at(6, 2) * file.at(3, 1));
  }
  const std::uint64_t listed = height * file.at(10, 2);
  if (!file.holds(512, 8 * std::max(rows, listed)))
  {
    return true;
  }
  for (std::uint64_t i = 0; i < rows; ++i)
  {
    if (!file.holds(file.at(512 + 4 * i, 4), file.at(512 + 4 * (listed + i), 4)))
    {
      return true;
    }
  }
  return false;
}

/// The first directory of a TIFF file, of 32 or ("BigTIFF") 64 bits.
class TiffDirectory
{
public:
  struct Field
  {
    std::uint64_t where = 0;
    std::uint64_t count = 0;
    std::uint64_t size = 0; ///< of a number
  };

  explicit TiffDirectory(const Numbers& file)
    : File(file)
    , Word(file.at(2, 2) == 43 ? 8 : 4)
    , Head(this->Word == 8 ? 8 : 2)
    , Start(file.at(this->Word, this->Word))
    , Count(file.at(this->Start, this->Head))
  {
  }
  bool isThere() const
  {
    return this->File.holds(this->Start, this->Head) && this->Count <= this->File.bytes &&
           this->File.holds(this->Start + this->Head, this->Count * this->entrySize());
  }
  /// Of no numbers where it lacks.
  Field field(std::uint64_t tag) const
  {
    for (std::uint64_t i = 0; i < this->Count; ++i)
    {
      const std::uint64_t entry = this->Start + this->Head + i * this->entrySize();
      if (this->File.at(entry, 2) == tag)
      {
        const std::uint64_t type = this->File.at(entry + 2, 2);
        Field field{ entry + 4 + this->Word, this->File.at(entry + 4, this->Word) };
        field.size = type == 3 ? 2 : type == 4 ? 4 : type == 5 || type == 16 ? 8 : 1;
        if (field.count > this->Word / field.size)
        {
          field.where = this->File.at(field.where, this->Word);
        }
        return field;
      }
    }
    return {};
  }
  bool holds(const Field& field) const
  {
    return field.count <= this->File.bytes && this->File.holds(field.where, field.count * field.size);
  }
  std::uint64_t number(const Field& field, std::uint64_t i, std::uint64_t otherwise) const
  {
    return i < field.count ? this->File.at(field.where + i * field.size, field.size) : otherwise;
  }
  std::uint64_t first(std::uint64_t tag, std::uint64_t otherwise) const
  {
    return this->number(this->field(tag), 0, otherwise);
  }

private:
  std::uint64_t entrySize() const { return 4 + 2 * this->Word; }

  const Numbers& File;
  std::uint64_t Word;
  std::uint64_t Head; ///< bytes of the count of its entries
  std::uint64_t Start;
  std::uint64_t Count;
};

/// TIFF 6.0: strips and tiles, each of which begins somewhere and has a count of bytes; and what colours depend on.
bool tiffLacksItsEnd(const Numbers& file)
{
  const TiffDirectory directory(file);
  if (!directory.isThere())
  {
    return true;
  }
  for (const int tag : { 258, 318, 320, 347 }) // bits, white point, colour map, tables of JPEG
  {
    if (!directory.holds(directory.field(std::uint64_t(tag))))
    {
      return true;
    }
  }
  // a count of the only strip that is too large is ignored by readers where nothing is packed: there are the rows
  const std::uint64_t row = (directory.first(256, 0) * directory.first(258, 1) * directory.first(277, 1) + 7) / 8;
  const std::uint64_t rows = row * directory.first(257, 0);
  const bool isPacked = directory.first(259, 1) != 1;
  for (const auto& [begin, count] : { std::pair{ 273, 279 }, std::pair{ 324, 325 } })
  {
    const TiffDirectory::Field begins = directory.field(begin);
    const TiffDirectory::Field counts = directory.field(count);
    if (!directory.holds(begins) || !directory.holds(counts))
    {
      return true;
    }
    const bool isBound = begins.count == 1 && begin == 273 && !isPacked;
    for (std::uint64_t i = 0; i < begins.count; ++i)
    {
      const std::uint64_t bytes = directory.number(counts, i, isBound ? rows : 0);
      if (!file.holds(directory.number(begins, i, 0), isBound ? std::min(bytes, rows) : bytes))
      {
        return true;
      }
    }
  }
  return false;
}
} // namespace

namespace dgtk::picture
{

bool lacksItsEnd(const std::uint8_t* data, std::size_t bytes)
{
  const Numbers file{ data, bytes, bytes > 0 && data[0] != 'I' && data[0] != 'R' };
  const std::uint64_t order = file.at(0, 2);
  if (order == 0x01da)
  {
    return sgiLacksItsEnd(file);
  }
  if (file.at(0, 4) == 0x46464952 && file.at(8, 4) == 0x50424557) // "RIFF" of that many bytes, "WEBP"
  {
    return !file.holds(8, file.at(4, 4));
  }
  const bool isTiff = (order == 0x4949 || order == 0x4d4d) && (file.at(2, 2) == 42 || file.at(2, 2) == 43);
  return isTiff && tiffLacksItsEnd(file);
}

} // namespace dgtk::picture
