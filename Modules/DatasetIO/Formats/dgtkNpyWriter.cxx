// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerFile.h"
#include "dgtkWriterEntry.h"

namespace dgtk
{

namespace
{
const char* descriptorOf(PixelType type)
{
  switch (type)
  {
    case PixelType::UInt8:
      return "|u1";
    case PixelType::UInt16:
      return "<u2";
    case PixelType::UInt32:
      return "<u4";
    case PixelType::Float32:
      return "<f4";
    case PixelType::Float64:
      return "<f8";
  }
  return "";
}

class NpyWriter : public LayerFileWriter
{
public:
  NpyWriter(const FilePlace& path, const LayerSpec& spec, int width, int height)
    : LayerFileWriter(path, spec, width, height)
  {
    this->append(npyHeader(spec.type, std::to_string(height) + ", " + std::to_string(width) +
                                        (spec.channels > 1 ? ", " + std::to_string(spec.channels) : std::string())));
  }

protected:
  void writeRows(const Rows& rows) override { this->append(rows.data(), rows.bytes()); }
};

bool canWriteNpy(const LayerSpec&) { return true; }

std::unique_ptr<LayerWriter> openNpy(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext&)
{
  return std::make_unique<NpyWriter>(path, spec, width, height);
}
} // namespace

std::string npyHeader(PixelType type, const std::string& shape)
{
  std::string text =
    std::string("{'descr': '") + descriptorOf(type) + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t prefix = 10;
  text.append(63 - (prefix + text.size()) % 64, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  putLittle(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

extern const WriterEntry writerNpy;
const WriterEntry writerNpy = { &canWriteNpy, &openNpy };

} // namespace dgtk
