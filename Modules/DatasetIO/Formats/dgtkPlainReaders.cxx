// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkInputFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
constexpr std::size_t longestHeader = 1 << 16;

/// What a header says about the pixels behind it.
struct Layout
{
  ImageInfo info;
  std::uint64_t start = 0;
  bool swapped = false; ///< big-endian
  bool bottomUp = false;
  bool flow = false; ///< 1e9 and more is unknown
};

class PlainReader : public RowReader
{
public:
  PlainReader(std::unique_ptr<InputFile> file, const Layout& layout)
    : File(std::move(file))
    , Pixels(layout)
  {
    this->Info = layout.info;
    const std::uint64_t expected = layout.start + layout.info.pixelBytes();
    if (this->File->size() != expected)
    {
      this->File->fail(std::min(expected, this->File->size()), "has the wrong size for its header",
        std::to_string(expected) + " bytes", std::to_string(this->File->size()) + " bytes");
    }
  }

protected:
  bool anyRow() const override { return true; }
  void readRows(Rows& rows) override
  {
    const std::size_t rowBytes = rows.rowBytes();
    const int first = this->Pixels.bottomUp ? this->Info.height - rows.y() - rows.height() : rows.y();
    this->File->read(this->Pixels.start + std::uint64_t(first) * rowBytes, rows.data(), rows.bytes());
    if (this->Pixels.bottomUp)
    {
      for (int top = 0, bottom = rows.height() - 1; top < bottom; ++top, --bottom)
      {
        std::swap_ranges(rows.data() + std::size_t(top) * rowBytes, rows.data() + std::size_t(top + 1) * rowBytes,
          rows.data() + std::size_t(bottom) * rowBytes);
      }
    }
    if (this->Pixels.swapped)
    {
      const std::size_t size = bytesOf(rows.type());
      for (std::size_t i = 0; i < rows.bytes(); i += size)
      {
        std::reverse(rows.data() + i, rows.data() + i + size);
      }
    }
    if (this->Pixels.flow)
    {
      float* const values = rows.row<float>(rows.y());
      for (std::size_t i = 0; i < rows.bytes() / 4; i += 2)
      {
        if (!(std::abs(values[i]) < 1e9f && std::abs(values[i + 1]) < 1e9f))
        {
          values[i] = values[i + 1] = std::numeric_limits<float>::quiet_NaN();
        }
      }
    }
  }

private:
  std::unique_ptr<InputFile> File;
  Layout Pixels;
};

/// Cuts a text header into words.
class HeaderText
{
public:
  HeaderText(const InputFile& file, std::size_t start, std::size_t bytes)
    : File(file)
    , Text(file.head(start + bytes))
    , At(start)
  {
  }

  std::size_t at() const { return this->At; }
  char peek() const { return this->At < this->Text.size() ? this->Text[this->At] : '\0'; }
  /// Skips blanks; with `comments` also from # to the end of the line.
  void skip(bool comments)
  {
    while (this->At < this->Text.size())
    {
      const char c = this->Text[this->At];
      if (comments && c == '#')
      {
        while (this->At < this->Text.size() && this->Text[this->At] != '\n')
        {
          ++this->At;
        }
      }
      else if (c != ' ' && c != '\n' && c != '\t' && c != '\r')
      {
        return;
      }
      else
      {
        ++this->At;
      }
    }
  }
  bool take(const std::string& word)
  {
    const bool there = this->Text.compare(this->At, word.size(), word) == 0;
    this->At += there ? word.size() : 0;
    return there;
  }
  void expect(const std::string& word)
  {
    if (!this->take(word))
    {
      this->fail("unexpected text", quoted(word));
    }
  }
  template <typename T>
  T number(const char* what)
  {
    T value{};
    const char* const start = this->Text.data() + this->At;
    const auto [end, error] = std::from_chars(start, this->Text.data() + this->Text.size(), value);
    if (error != std::errc())
    {
      this->fail("unexpected text", what);
    }
    this->At += static_cast<std::size_t>(end - start);
    return value;
  }
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const
  {
    this->File.fail(this->At, what, expected,
      this->At < this->Text.size() ? quoted(this->Text.substr(this->At, 16)) : "the end of the header");
  }

private:
  const InputFile& File;
  std::string Text;
  std::size_t At;
};

PixelType npyType(HeaderText& text, bool& swapped)
{
  struct Row
  {
    const char* code;
    PixelType type;
  };
  constexpr Row rows[] = { { "u1", PixelType::UInt8 }, { "u2", PixelType::UInt16 }, { "u4", PixelType::UInt32 },
    { "f4", PixelType::Float32 }, { "f8", PixelType::Float64 } };
  swapped = text.peek() == '>';
  if (!text.take("<") && !text.take(">"))
  {
    text.expect("|");
  }
  for (const Row& row : rows)
  {
    if (text.take(row.code))
    {
      return row.type;
    }
  }
  text.fail("unsupported type of array", "u1, u2, u4, f4 or f8");
}

void npyShape(const InputFile& file, HeaderText& text, ImageInfo& info)
{
  std::int64_t sides[3] = { 0, 0, 1 };
  int count = 0;
  const std::uint64_t at = text.at();
  text.expect("(");
  for (text.skip(false); text.peek() != ')'; text.skip(false))
  {
    if (count == 3)
    {
      text.fail("too many dimensions", "(H, W) or (H, W, C)");
    }
    sides[count++] = text.number<std::int64_t>("a number");
    text.skip(false);
    if (text.peek() != ')')
    {
      text.expect(",");
    }
  }
  text.expect(")");
  if (count < 2 || sides[2] < 1 || sides[2] > 1024)
  {
    file.fail(at, "not the shape of an image", "(H, W) or (H, W, C)");
  }
  checkImageSize(file, at, sides[1], sides[0] == 0 ? 1 : sides[0]); // tables may be empty
  info.height = static_cast<int>(sides[0]);
  info.width = static_cast<int>(sides[1]);
  info.channels = static_cast<int>(sides[2]);
}

Layout npyLayout(const InputFile& file, DepthMatrices*)
{
  const std::string head = file.head(12);
  if (head.compare(0, 6, "\x93NUMPY") != 0)
  {
    file.fail(0, "is not a NumPy file", "the word NUMPY", quoted(head.substr(0, 6)));
  }
  const int version = file.value<std::uint8_t>(6);
  if (version < 1 || version > 3)
  {
    file.fail(6, "unsupported version of NumPy files", "1, 2 or 3", std::to_string(version));
  }
  const std::uint64_t prefix = version == 1 ? 10 : 12;
  const std::uint64_t length = version == 1 ? file.value<std::uint16_t>(8) : file.value<std::uint32_t>(8);
  if (length > longestHeader || prefix + length > file.size())
  {
    file.fail(8, "unusable length of the header", {}, std::to_string(length));
  }
  HeaderText text(file, static_cast<std::size_t>(prefix), static_cast<std::size_t>(length));
  Layout layout;
  layout.start = prefix + length;
  bool seen[3] = {};
  text.expect("{");
  for (text.skip(false); text.peek() != '}'; text.skip(false))
  {
    if (text.take("'descr':"))
    {
      text.skip(false);
      text.expect("'");
      layout.info.type = npyType(text, layout.swapped);
      text.expect("'");
      seen[0] = true;
    }
    else if (text.take("'fortran_order':"))
    {
      text.skip(false);
      text.expect("False");
      seen[1] = true;
    }
    else
    {
      text.expect("'shape':");
      text.skip(false);
      npyShape(file, text, layout.info);
      seen[2] = true;
    }
    text.skip(false);
    if (text.peek() != '}')
    {
      text.expect(",");
    }
  }
  if (!seen[0] || !seen[1] || !seen[2])
  {
    text.fail("incomplete header", "descr, fortran_order and shape");
  }
  return layout;
}

Layout ppmLayout(const InputFile& file, DepthMatrices*)
{
  HeaderText text(file, 0, longestHeader);
  Layout layout;
  layout.info.channels = text.take("P5") ? 1 : 3;
  if (layout.info.channels == 3)
  {
    text.expect("P6");
  }
  text.skip(true);
  const std::uint64_t at = text.at();
  const auto width = text.number<std::int64_t>("the width");
  text.skip(true);
  const auto height = text.number<std::int64_t>("the height");
  checkImageSize(file, at, width, height);
  layout.info.width = static_cast<int>(width);
  layout.info.height = static_cast<int>(height);
  text.skip(true);
  const auto top = text.number<std::int64_t>("the largest value");
  if (top != 255 && top != 65535)
  {
    text.fail("unsupported largest value", "255 or 65535");
  }
  layout.info.type = top == 255 ? PixelType::UInt8 : PixelType::UInt16;
  layout.swapped = true;
  layout.start = text.at() + 1; // one blank
  return layout;
}

Layout pfmLayout(const InputFile& file, DepthMatrices*)
{
  HeaderText text(file, 0, longestHeader);
  Layout layout;
  layout.info.type = PixelType::Float32;
  layout.info.channels = text.take("PF") ? 3 : 1;
  if (layout.info.channels == 1)
  {
    text.expect("Pf");
  }
  text.skip(false);
  const std::uint64_t at = text.at();
  const auto width = text.number<std::int64_t>("the width");
  text.skip(false);
  const auto height = text.number<std::int64_t>("the height");
  checkImageSize(file, at, width, height);
  layout.info.width = static_cast<int>(width);
  layout.info.height = static_cast<int>(height);
  text.skip(false);
  const auto scale = text.number<double>("the scale");
  if (!(std::abs(scale) == 1.0))
  {
    text.fail("unsupported scale", "1 or -1");
  }
  layout.swapped = scale > 0;
  layout.bottomUp = true;
  layout.start = text.at() + 1; // one line break
  return layout;
}

void readSides(const InputFile& file, std::uint64_t offset, ImageInfo& info)
{
  info.width = file.value<std::int32_t>(offset);
  info.height = file.value<std::int32_t>(offset + 4);
  checkImageSize(file, offset, info.width, info.height);
}

Layout dgdLayout(const InputFile& file, DepthMatrices* matrices)
{
  Layout layout;
  layout.info.type = PixelType::Float64;
  layout.info.channels = 1;
  DepthMatrices read;
  file.read(0, read.projection.data(), 128);
  file.read(128, read.modelView.data(), 128);
  if (!read.projection.allFinite() || !read.modelView.allFinite())
  {
    file.fail(0, "the matrices are not finite numbers");
  }
  if (matrices)
  {
    *matrices = read;
  }
  readSides(file, 256, layout.info);
  layout.start = 264;
  return layout;
}

Layout floLayout(const InputFile& file, DepthMatrices*)
{
  Layout layout;
  layout.info.type = PixelType::Float32;
  layout.info.channels = 2;
  const std::string head = file.head(4);
  if (head != "PIEH")
  {
    file.fail(0, "is not a flow file", "the word PIEH", quoted(head));
  }
  readSides(file, 4, layout.info);
  layout.start = 12;
  layout.flow = true;
  return layout;
}

template <Layout (*Parse)(const InputFile&, DepthMatrices*)>
std::unique_ptr<RowReader> openPlain(const std::string& path, DepthMatrices* matrices)
{
  auto file = std::make_unique<InputFile>(path);
  Layout layout = Parse(*file, matrices);
  const std::size_t dot = path.find_last_of('.');
  layout.info.format = path.substr(dot + 1);
  return std::make_unique<PlainReader>(std::move(file), layout);
}
} // namespace

RowReaderFactory plainReader(const std::string& extension)
{
  struct Row
  {
    const char* extension;
    RowReaderFactory open;
  };
  static constexpr Row rows[] = { { "npy", &openPlain<npyLayout> }, { "ppm", &openPlain<ppmLayout> },
    { "pgm", &openPlain<ppmLayout> }, { "pfm", &openPlain<pfmLayout> }, { "dgd", &openPlain<dgdLayout> },
    { "flo", &openPlain<floLayout> } };
  for (const Row& row : rows)
  {
    if (extension == row.extension)
    {
      return row.open;
    }
  }
  return nullptr;
}

} // namespace dgtk
