// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerFile.h"
#include "dgtkWriterEntry.h"

#include <cmath>

namespace dgtk
{

namespace
{
/// Middlebury optical flow: "PIEH", int32 width and height, float32 u and v; 1e10 where the flow is unknown.
class FloWriter : public LayerFileWriter
{
public:
  FloWriter(const FilePlace& path, const LayerSpec& spec, int width, int height)
    : LayerFileWriter(path, spec, width, height)
  {
    std::string header = "PIEH";
    putLittle(header, static_cast<std::int32_t>(width));
    putLittle(header, static_cast<std::int32_t>(height));
    this->append(header);
  }

protected:
  void writeRows(const Rows& rows) override
  {
    narrow(rows, this->Values);
    for (std::size_t i = 0; i < this->Values.size(); i += 2)
    {
      if (std::isnan(this->Values[i]) || std::isnan(this->Values[i + 1]))
      {
        this->Values[i] = this->Values[i + 1] = 1e10f;
      }
    }
    this->append(this->Values.data(), this->Values.size() * 4);
  }

private:
  std::vector<float> Values;
};

bool canWriteFlo(const LayerSpec& spec)
{
  return spec.channels == 2 && (spec.type == PixelType::Float32 || spec.type == PixelType::Float64);
}

std::unique_ptr<LayerWriter> openFlo(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext&)
{
  return std::make_unique<FloWriter>(path, spec, width, height);
}
} // namespace

extern const WriterEntry writerFlo;
const WriterEntry writerFlo = { &canWriteFlo, &openFlo, true };

} // namespace dgtk
