// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerFile.h"
#include "dgtkWriterEntry.h"

namespace dgtk
{

namespace
{
/// P6. Colours of 8 or 16 bits as they are; ids as 24-bit numbers, red high (section 4.4 of the thesis).
class PpmWriter : public LayerFileWriter
{
public:
  PpmWriter(const FilePlace& path, const LayerSpec& spec, int width, int height)
    : LayerFileWriter(path, spec, width, height)
  {
    this->append("P6\n" + std::to_string(width) + ' ' + std::to_string(height) + '\n' +
                 (spec.type == PixelType::UInt16 ? "65535\n" : "255\n"));
  }

protected:
  void writeRows(const Rows& rows) override
  {
    switch (rows.type())
    {
      case PixelType::UInt8:
        this->append(rows.data(), rows.bytes());
        return;
      case PixelType::UInt16:
        this->packColors(rows);
        break;
      default:
        this->packIds(rows);
    }
    this->append(this->Packed.data(), this->Packed.size());
  }

private:
  void packColors(const Rows& rows)
  {
    const std::size_t count = rows.bytes() / 2;
    const std::uint16_t* from = rows.row<std::uint16_t>(rows.y());
    this->Packed.resize(count * 2);
    for (std::size_t i = 0; i < count; ++i)
    {
      putBig16(&this->Packed[i * 2], from[i]);
    }
  }

  void packIds(const Rows& rows)
  {
    const std::size_t count = rows.bytes() / 4;
    const std::uint32_t* from = rows.row<std::uint32_t>(rows.y());
    this->Packed.resize(count * 3);
    std::uint32_t all = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint32_t id = from[i];
      all |= id;
      this->Packed[i * 3] = static_cast<unsigned char>(id >> 16);
      this->Packed[i * 3 + 1] = static_cast<unsigned char>(id >> 8);
      this->Packed[i * 3 + 2] = static_cast<unsigned char>(id);
    }
    if (all >> 24)
    {
      refuseIds(from, count, 0xffffff, "a 24-bit .ppm", this->Spec.name);
    }
  }

  std::vector<unsigned char> Packed;
};

bool canWritePpm(const LayerSpec& spec)
{
  return (spec.channels == 3 && (spec.type == PixelType::UInt8 || spec.type == PixelType::UInt16)) ||
         (spec.channels == 1 && spec.type == PixelType::UInt32);
}

std::unique_ptr<LayerWriter> openPpm(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext&)
{
  return std::make_unique<PpmWriter>(path, spec, width, height);
}
} // namespace

extern const WriterEntry writerPpm;
const WriterEntry writerPpm = { &canWritePpm, &openPpm, false, 0xffffff };

} // namespace dgtk
