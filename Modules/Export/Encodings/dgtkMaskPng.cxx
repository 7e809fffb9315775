// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMaskPng.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace dgtk
{

namespace
{
/// Bits of a deflate stream (RFC 1951), the lowest first.
class Bits
{
public:
  void put(std::uint32_t value, int count)
  {
    this->Held |= std::uint64_t(value) << this->Count;
    this->Count += count;
    for (; this->Count >= 8; this->Count -= 8, this->Held >>= 8)
    {
      this->Bytes += static_cast<char>(this->Held & 255);
    }
  }
  /// A Huffman code, whose highest bit comes first.
  void code(std::uint32_t value, int count)
  {
    std::uint32_t turned = 0;
    for (int i = 0; i < count; ++i)
    {
      turned |= (value >> i & 1) << (count - 1 - i);
    }
    this->put(turned, count);
  }
  const std::string& end()
  {
    this->put(0, (8 - this->Count) % 8);
    return this->Bytes;
  }

private:
  std::string Bytes;
  std::uint64_t Held = 0;
  int Count = 0;
};

/// Deflates bytes that are mostly 0 into one block with a code of its own: 258 zeros take two bits.
///
/// | symbols | bits |
/// |---|---|
/// | 285: 258 zeros | 1 |
/// | 0, 1, 2, 255: bytes that residuals of masks have | 4 |
/// | 3, 4, 5 (which make the code complete), 256 (the end), 257 to 284 (3 to 257 zeros) | 7 |
class ZeroDeflater
{
public:
  ZeroDeflater() { this->head(); }

  void zeros(std::uint64_t count)
  {
    this->Pending += count;
    constexpr std::uint64_t modulus = 65521;
    this->B = (this->B + count % modulus * this->A) % modulus;
  }
  void byte(unsigned char value)
  {
    this->flush();
    this->symbol(value);
    constexpr std::uint64_t modulus = 65521;
    this->A = (this->A + value) % modulus;
    this->B = (this->B + this->A) % modulus;
  }
  /// The zlib stream.
  std::string finish()
  {
    constexpr std::uint32_t endOfBlock = 256;
    this->flush();
    this->symbol(endOfBlock);
    std::string stream = "\x78\x01" + this->Out.end();
    const auto adler = static_cast<std::uint32_t>(this->B << 16 | this->A);
    for (int shift = 24; shift >= 0; shift -= 8)
    {
      stream += static_cast<char>(adler >> shift & 255);
    }
    return stream;
  }

private:
  static constexpr int shortest = 1;
  static constexpr int usual = 4;
  static constexpr int longest = 7;

  static int lengthOf(std::uint32_t symbol)
  {
    return symbol == 285 ? shortest : symbol <= 2 || symbol == 255 ? usual : symbol <= 5 || symbol >= 256 ? longest : 0;
  }

  /// Lengths of the code's words, themselves coded: zeros in runs, the rest one by one.
  void head()
  {
    constexpr std::uint32_t dynamicLast = 0b101;
    this->Out.put(dynamicLast, 3);
    this->Out.put(286 - 257, 5); // literals and lengths
    this->Out.put(1 - 1, 5);     // distances: 1
    // code lengths in use: 1, 4, 7 and 18 (11 to 138 zeros), two bits each
    static constexpr std::array<int, 19> order{ 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    this->Out.put(18 - 4, 4);
    for (std::size_t i = 0; i < 18; ++i)
    {
      const int length = order[i];
      this->Out.put(length == 1 || length == 4 || length == 7 || length == 18 ? 2 : 0, 3);
    }
    const auto lengthCode = [this](int length) {
      this->Out.code(length == 1 ? 0 : length == 4 ? 1 : length == 7 ? 2 : 3, 2);
    };
    for (std::uint32_t symbol = 0; symbol < 286;)
    {
      const int length = lengthOf(symbol);
      std::uint32_t run = 1;
      while (length == 0 && run < 138 && symbol + run < 286 && lengthOf(symbol + run) == 0)
      {
        ++run;
      }
      lengthCode(length == 0 ? 18 : length);
      if (length == 0)
      {
        this->Out.put(run - 11, 7);
      }
      symbol += run;
    }
    lengthCode(1); // the one distance
  }

  /// The words of the code in the order of their lengths, then of the symbols.
  void symbol(std::uint32_t symbol)
  {
    const int length = lengthOf(symbol);
    const std::uint32_t place = length == shortest ? 0
                                : length == usual  ? (symbol == 255 ? 3 : symbol)
                                                   : (symbol <= 5 ? symbol - 3 : symbol - 256 + 3);
    constexpr std::uint32_t firstUsual = 0b1000;
    constexpr std::uint32_t firstLongest = 0b1100000;
    this->Out.code(place + (length == usual ? firstUsual : length == longest ? firstLongest : 0), length);
  }

  /// The zeros that wait: one byte, and runs that repeat it.
  void flush()
  {
    constexpr std::uint64_t most = 258;
    constexpr std::uint64_t least = 3;
    if (this->Pending > 0)
    {
      this->symbol(0);
      --this->Pending;
    }
    for (; this->Pending >= most; this->Pending -= most)
    {
      this->symbol(285);
      this->Out.put(0, 1);
    }
    if (this->Pending >= least)
    {
      this->repeat(static_cast<std::uint32_t>(this->Pending));
      this->Pending = 0;
    }
    for (; this->Pending > 0; --this->Pending)
    {
      this->symbol(0);
    }
  }

  /// 3 to 257 zeros (RFC 1951, 3.2.5): symbols of equal numbers of further bits come in fours.
  void repeat(std::uint32_t count)
  {
    const std::uint32_t from = count - 3;
    int bits = 0;
    while (from >> (bits + 3) != 0)
    {
      ++bits;
    }
    const std::uint32_t symbol = 257 + static_cast<std::uint32_t>(bits) * 4 + (from >> bits);
    this->symbol(symbol);
    this->Out.put(from & ((1U << bits) - 1), bits);
    this->Out.put(0, 1);
  }

  Bits Out;
  std::uint64_t Pending = 0;
  std::uint64_t A = 1; ///< of Adler-32
  std::uint64_t B = 0;
};

/// The pixels of a mask's box, row by row.
struct Box
{
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::vector<unsigned char> pixels;

  explicit Box(const RunLengths& mask)
  {
    const Eigen::Vector4d box = mask.box();
    this->x = static_cast<int>(box[0]);
    this->y = static_cast<int>(box[1]);
    this->width = static_cast<int>(box[2]);
    this->height = static_cast<int>(box[3]);
    this->pixels.resize(std::size_t(this->width) * std::size_t(this->height));
    const auto rows = std::uint64_t(mask.height);
    std::uint64_t begin = 0;
    for (std::size_t i = 0; i < mask.counts.size(); begin += mask.counts[i++])
    {
      const std::uint64_t end = begin + mask.counts[i];
      for (std::uint64_t at = begin; i % 2 == 1 && at < end;)
      {
        const std::uint64_t column = at / rows;
        const std::uint64_t last = std::min(end, (column + 1) * rows);
        unsigned char* pixel = this->pixels.data() + (at % rows - std::uint64_t(this->y)) * std::uint64_t(this->width) +
                               (column - std::uint64_t(this->x));
        for (; at < last; ++at, pixel += this->width)
        {
          *pixel = 255;
        }
      }
    }
  }
  const unsigned char* row(int line) const
  {
    return this->pixels.data() + std::size_t(line) * std::size_t(this->width);
  }
};

/// A row of the box less the one above it.
void residuals(ZeroDeflater& out, const Box& box, const unsigned char* above, const unsigned char* row, int imageWidth)
{
  constexpr unsigned char up = 2;
  out.byte(up);
  out.zeros(std::uint64_t(box.x));
  int done = 0;
  while (done < box.width)
  {
    const auto differs = std::mismatch(row + done, row + box.width, above + done).first - row;
    out.zeros(std::uint64_t(differs - done));
    done = static_cast<int>(differs);
    for (; done < box.width && row[done] != above[done]; ++done)
    {
      out.byte(static_cast<unsigned char>(row[done] - above[done]));
    }
  }
  out.zeros(std::uint64_t(imageWidth - box.x - box.width));
}

void putBig32(std::string& to, std::uint32_t value)
{
  for (int shift = 24; shift >= 0; shift -= 8)
  {
    to += static_cast<char>(value >> shift & 255);
  }
}

void chunk(std::string& to, const std::string& type, const std::string& data)
{
  putBig32(to, static_cast<std::uint32_t>(data.size()));
  const std::string body = type + data;
  to += body;
  putBig32(to,
    static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
}
} // namespace

std::string maskPng(const RunLengths& mask)
{
  const Box box(mask);
  const std::uint64_t line = std::uint64_t(mask.width) + 1; // with the number of its filter, 0 for rows of nothing
  ZeroDeflater out;
  out.zeros(line * std::uint64_t(box.height > 0 ? box.y : mask.height));
  const std::vector<unsigned char> nothing(std::size_t(box.width));
  for (int y = 0; y < box.height; ++y)
  {
    residuals(out, box, y > 0 ? box.row(y - 1) : nothing.data(), box.row(y), mask.width);
  }
  out.zeros(box.height > 0 ? line * std::uint64_t(mask.height - box.y - box.height) : 0);
  std::string head;
  putBig32(head, static_cast<std::uint32_t>(mask.width));
  putBig32(head, static_cast<std::uint32_t>(mask.height));
  head += std::string("\x08\0\0\0\0", 5); // 8 bits of gray
  std::string file = "\x89PNG\r\n\x1a\n";
  chunk(file, "IHDR", head);
  chunk(file, "IDAT", out.finish());
  chunk(file, "IEND", "");
  return file;
}

} // namespace dgtk
