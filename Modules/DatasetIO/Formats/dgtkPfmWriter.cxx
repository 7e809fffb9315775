// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerFile.h"
#include "dgtkWriterEntry.h"

namespace dgtk
{

namespace
{
/// Portable float map: float32, the bottom row first; the negative scale says little-endian.
class PfmWriter : public LayerFileWriter
{
public:
  PfmWriter(const FilePlace& path, const LayerSpec& spec, int width, int height)
    : LayerFileWriter(path, spec, width, height)
  {
    const std::string header =
      (spec.channels == 3 ? "PF\n" : "Pf\n") + std::to_string(width) + ' ' + std::to_string(height) + "\n-1\n";
    this->writeAt(0, header.data(), header.size());
    this->Start = header.size();
  }

protected:
  void writeRows(const Rows& rows) override
  {
    narrow(rows, this->Values);
    const std::size_t rowValues = std::size_t(this->Width) * static_cast<std::size_t>(rows.channels());
    // the block upside down, in one piece
    this->Flipped.resize(this->Values.size());
    for (int i = 0; i < rows.height(); ++i)
    {
      std::memcpy(&this->Flipped[std::size_t(rows.height() - 1 - i) * rowValues],
        &this->Values[std::size_t(i) * rowValues], rowValues * 4);
    }
    if (rows.height() > 0)
    {
      const int below = this->Height - rows.y() - rows.height();
      this->writeAt(this->Start + std::uint64_t(below) * rowValues * 4, this->Flipped.data(), this->Flipped.size() * 4);
    }
  }

private:
  std::uint64_t Start = 0;
  std::vector<float> Values;
  std::vector<float> Flipped;
};

bool canWritePfm(const LayerSpec& spec)
{
  return (spec.type == PixelType::Float32 || spec.type == PixelType::Float64) &&
         (spec.channels == 1 || spec.channels == 3);
}

std::unique_ptr<LayerWriter> openPfm(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext&)
{
  return std::make_unique<PfmWriter>(path, spec, width, height);
}
} // namespace

extern const WriterEntry writerPfm;
const WriterEntry writerPfm = { &canWritePfm, &openPfm, true };

} // namespace dgtk
