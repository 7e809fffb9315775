// SPDX-License-Identifier: BSD-3-Clause
// The library dgtkdeepexr: deep scan lines by OpenImageIO, which brings some 250 libraries along; loaded when a deep
// file is written. Uses nothing of ours but types.
#include "dgtkDeepExrFile.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

namespace dgtk
{

namespace
{
constexpr const char* channelNames[] = { "R", "G", "B", "A", "Z", "id", "part", "triangle" };
constexpr int floatChannels = 5;
constexpr int channelCount = 8;
// OpenImageIO would write the time of day.
constexpr const char* noDate = "1970:01:01 00:00:00";

class OpenImageIOFile : public DeepExrFile
{
public:
  OpenImageIOFile(const std::string& path, int width, int height)
    : Spec(width, height, channelCount, OIIO::TypeDesc::FLOAT)
    , Output(OIIO::ImageOutput::create("exr"))
  {
    this->Spec.deep = true;
    this->Spec.channelnames.assign(channelNames, channelNames + channelCount);
    this->Spec.alpha_channel = 3;
    this->Spec.z_channel = 4;
    this->Spec.channelformats.assign(floatChannels, OIIO::TypeDesc::FLOAT);
    this->Spec.channelformats.resize(channelCount, OIIO::TypeDesc::UINT32);
    this->Spec.attribute("compression", "zips");
    this->Spec.attribute("DateTime", noDate);
    this->Spec.attribute("oiio:ColorSpace", "Linear");
    this->Opened = this->Output && this->Output->supports("deepdata") && this->Output->open(path, this->Spec);
  }

  bool opened() const override { return this->Opened; }

  bool write(const LdiRows& rows) override
  {
    const std::size_t pixels = rows.counts.size();
    OIIO::DeepData deep;
    deep.init(static_cast<std::int64_t>(pixels), channelCount, this->Spec.channelformats, this->Spec.channelnames);
    deep.set_all_samples(rows.counts);
    const LdiSurface* surface = rows.surfaces.data();
    for (std::size_t i = 0; i < pixels; ++i)
    {
      for (std::uint32_t s = 0; s < rows.counts[i]; ++s, ++surface)
      {
        set(deep, static_cast<std::int64_t>(i), static_cast<int>(s), *surface);
      }
    }
    return this->Output->write_deep_scanlines(rows.y, rows.y + rows.height, 0, deep);
  }

  bool close() override { return this->Output->close(); }

  std::string error() const override
  {
    const std::string why = this->Output ? this->Output->geterror() : OIIO::geterror();
    return why.empty() ? "OpenImageIO has no deep EXR" : why;
  }

private:
  static void set(OIIO::DeepData& deep, std::int64_t pixel, int sample, const LdiSurface& surface)
  {
    const float alpha = surface.rgba[3];
    for (int c = 0; c < 3; ++c)
    {
      deep.set_deep_value(pixel, c, sample, surface.rgba[c] * alpha);
    }
    deep.set_deep_value(pixel, 3, sample, alpha);
    deep.set_deep_value(pixel, 4, sample, static_cast<float>(surface.depth));
    deep.set_deep_value(pixel, 5, sample, surface.object);
    deep.set_deep_value(pixel, 6, sample, surface.part);
    deep.set_deep_value(pixel, 7, sample, surface.triangle);
  }

  OIIO::ImageSpec Spec;
  std::unique_ptr<OIIO::ImageOutput> Output;
  bool Opened = false;
};
} // namespace

} // namespace dgtk

const dgtk::DeepExrCalls* dgtkdeepexrCalls()
{
  static const dgtk::DeepExrCalls calls{ [](const std::string& path, int width,
                                           int height) -> std::unique_ptr<dgtk::DeepExrFile>
    { return std::make_unique<dgtk::OpenImageIOFile>(path, width, height); } };
  return &calls;
}
