// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerFile.h"
#include "dgtkWriterEntry.h"

namespace dgtk
{

namespace
{
/// The thesis's depth map (section 4.4): projection and model-view matrix, column-major, size, depth in float64.
class DgdWriter : public LayerFileWriter
{
public:
  DgdWriter(const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext& context)
    : LayerFileWriter(path, spec, width, height)
  {
    std::string header;
    for (const Eigen::Matrix4d* matrix : { &context.projection, &context.modelView })
    {
      for (int k = 0; k < 16; ++k)
      {
        putLittle(header, (*matrix)(k % 4, k / 4));
      }
    }
    putLittle(header, static_cast<std::int32_t>(width));
    putLittle(header, static_cast<std::int32_t>(height));
    this->append(header);
  }

protected:
  void writeRows(const Rows& rows) override { this->append(rows.data(), rows.bytes()); }
};

bool canWriteDgd(const LayerSpec& spec)
{
  return spec.meaning == Meaning::Depth && spec.channels == 1 && spec.type == PixelType::Float64;
}

std::unique_ptr<LayerWriter> openDgd(
  const FilePlace& path, const LayerSpec& spec, int width, int height, const LayerWriterContext& context)
{
  return std::make_unique<DgdWriter>(path, spec, width, height, context);
}
} // namespace

extern const WriterEntry writerDgd;
const WriterEntry writerDgd = { &canWriteDgd, &openDgd, false, 0xffffffff, false, true };

} // namespace dgtk
