// SPDX-License-Identifier: BSD-3-Clause
// A file format of a program of its own: numbers as text, a line a row.
#include <dgtkLayerFile.h>
#include <dgtkWriterEntry.h>

#include <charconv>

namespace
{
using namespace dgtk;

class TextWriter : public LayerFileWriter
{
public:
  using LayerFileWriter::LayerFileWriter;

protected:
  void writeRows(const Rows& rows) override
  {
    for (int y = rows.y(); y < rows.y() + rows.height(); ++y)
    {
      std::string line;
      for (int i = 0; i < rows.width() * rows.channels(); ++i)
      {
        char text[32];
        line += (line.empty() ? "" : " ") +
                std::string(text, std::to_chars(text, text + sizeof text, rows.row<double>(y)[i]).ptr);
      }
      this->append(line + "\n");
    }
  }
};

bool canWriteText(const LayerSpec& spec) { return spec.type == PixelType::Float64; }

std::unique_ptr<LayerWriter> openText(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext&)
{
  return std::make_unique<TextWriter>(path, spec, width, height);
}

const WriterEntry entry = { &canWriteText, &openText };
const bool writerAdded = addWriter({ "Text", "text", "txt", "numbers as text" }, entry); // the row
} // namespace
