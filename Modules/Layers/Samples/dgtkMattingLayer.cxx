// SPDX-License-Identifier: BSD-3-Clause
// The layer matting: foreground, background, alpha, composite and trimap of chosen objects.
#include "dgtkError.h"
#include "dgtkLayers.h"
#include "dgtkMatte.h"

#include <algorithm>
#include <array>

namespace dgtk
{

namespace
{
enum Picture
{
  Foreground,
  Background,
  Alpha,
  Composite,
  Trimap,
  PictureCount
};
const std::array<const char*, PictureCount> pictureNames{ "foreground", "background", "alpha", "composite", "trimap" };

const NamesOption matteOption("matte", "NAMES", "objects of the matting layer");

LayerSpec pictureSpec(int picture)
{
  const bool color = picture == Foreground || picture == Background || picture == Composite;
  LayerSpec spec;
  spec.name = std::string("matting_") + pictureNames[picture];
  spec.type = picture == Trimap ? PixelType::UInt8 : PixelType::UInt16;
  spec.channels = color ? 3 : 1;
  spec.unit = color ? "sRGB" : picture == Alpha ? "1/65535" : "class";
  spec.frame = "image";
  spec.invalid = picture == Foreground ? "0" : "none";
  const std::array<const char*, PictureCount> descriptions{
    "mean colour, as displayed, of the pixel's samples that show the object; 0 where none does",
    "mean colour, as displayed, of the pixel's samples in the scene without the object",
    "share of the pixel's samples that show the object",
    "alpha foreground + (1 - alpha) background of the values in these files, rounded",
    "0 background, 255 the object, 128 within two pixels of a pixel that is neither alone"
  };
  spec.description = descriptions[picture];
  spec.meaning = color ? Meaning::Picture : picture == Alpha ? Meaning::Coverage : Meaning::Mask;
  return spec;
}

/// Folder of an object's files: its name where that can be one, and is not as those of ids are, otherwise its id.
std::string folderOf(const std::string& name, std::uint32_t id)
{
  const bool usable = !name.empty() && name[0] != '#' && name.size() <= 128 &&
                      name.find_first_of(std::string("/\\\0", 3)) == std::string::npos;
  return "matting_" + (usable ? name : '#' + std::to_string(id));
}

/// Ids of the objects of a request, each once, in its order. Throws UsageError for a name that no object has.
std::vector<std::uint32_t> matteObjects(const LayerRequest& request, const Stage& stage)
{
  std::vector<std::uint32_t> objects;
  const std::vector<std::string> names = stage.objectNames();
  for (const std::string& name : matteOption.of(request.options))
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
    {
      throw UsageError("matte: the scene has no object " + quoted(name));
    }
    const auto id = static_cast<std::uint32_t>(found - names.begin() + 1);
    if (std::find(objects.begin(), objects.end(), id) == objects.end())
    {
      objects.push_back(id);
    }
  }
  return objects;
}

/// The pictures of an object have consecutive outputs.
class MattingPass : public LayerPass
{
public:
  explicit MattingPass(const JobContext& context)
    : Samples(option::samples().of(context.plan.request.options))
    , Pool(context.pool)
  {
    const std::size_t objects = matteObjects(context.plan.request, context.queries.stage()).size();
    for (std::size_t i = 0; i < objects; ++i)
    {
      this->Mattes.emplace_back(context.view.model->width(), this->Samples);
    }
  }

  void band(const Band& band, LayerSink& sink) override
  {
    for (std::size_t i = 0; i < this->Mattes.size(); ++i)
    {
      const MattePixels& pixels = band.mattes[i];
      std::vector<Rows> rows;
      for (int picture = 0; picture < Trimap; ++picture)
      {
        const LayerSpec spec = pictureSpec(picture);
        rows.emplace_back(spec.type, spec.channels, band.rect.width, band.rect.y, band.rect.height);
      }
      const int y = band.rect.y;
      composeMatte(pixels.count.data(), pixels.foreground.data(), pixels.background.data(), this->Samples,
        pixels.count.size(), rows[Foreground].row<std::uint16_t>(y), rows[Background].row<std::uint16_t>(y),
        rows[Alpha].row<std::uint16_t>(y), rows[Composite].row<std::uint16_t>(y));
      this->Mattes[i].addRows(pixels.count.data(), band.rect.height);
      this->Pool.parallelFor(
        Trimap, [&](int picture) { sink.rows(PictureCount * i + std::size_t(picture), rows[std::size_t(picture)]); });
    }
  }

  void finish(LayerSink& sink) override
  {
    for (std::size_t i = 0; i < this->Mattes.size(); ++i)
    {
      writeTrimap(this->Mattes[i], PictureCount * i + Trimap, sink);
    }
  }

private:
  static void writeTrimap(const Matte& matte, std::size_t output, LayerSink& sink)
  {
    constexpr int block = 64;
    for (int y = 0; y < matte.height(); y += block)
    {
      Rows rows(PixelType::UInt8, 1, matte.width(), y, std::min(block, matte.height() - y));
      for (int row = y; row < y + rows.height(); ++row)
      {
        matte.trimapRow(row, rows.row<std::uint8_t>(row));
      }
      sink.rows(output, rows);
    }
  }

  int Samples;
  ThreadPool& Pool;
  std::vector<Matte> Mattes; // one an object
};

class MattingLayer final : public Layer
{
public:
  LayerInfo info() const override
  {
    return { "matting", { "png" }, "foreground, background, alpha, composite and trimap of chosen objects" };
  }
  LayerNeeds needs(const LayerRequest& request, const Stage& stage) const override
  {
    LayerNeeds needs;
    needs.samples = true;
    needs.mattes = matteObjects(request, stage);
    return needs;
  }
  std::string requirement() const override { return "the names of the objects to cut out (matte)"; }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    std::vector<LayerRecord> records;
    records.reserve(PictureCount);
    for (int picture = 0; picture < PictureCount; ++picture)
    {
      records.push_back({ pictureSpec(picture), format });
    }
    return records;
  }
  std::vector<const OptionRow*> options() const override { return { &matteOption }; }
  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    std::vector<LayerOutput> all;
    const std::vector<std::string> names = stage.objectNames();
    for (const std::uint32_t id : matteObjects(plan.request, stage))
    {
      const std::string folder = folderOf(names[id - 1], id);
      for (int picture = 0; picture < PictureCount; ++picture)
      {
        LayerOutput output = imageOutput(plan, stage, job, pictureSpec(picture), planned.formats);
        output.path = WorkPlan::stem(stage.cameraNames()[job.camera], folder, job.frame) + '_' + pictureNames[picture];
        output.name = folder + '_' + pictureNames[picture];
        all.push_back(output);
      }
    }
    return all;
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>&) const override
  {
    return std::make_unique<MattingPass>(context);
  }
};
} // namespace

LayerList mattingLayers() { return { std::make_shared<MattingLayer>() }; }

} // namespace dgtk
