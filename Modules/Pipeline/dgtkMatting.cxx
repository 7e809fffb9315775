// SPDX-License-Identifier: BSD-3-Clause
// The layer matting: foreground, background, alpha, composite and trimap of the objects of --matte.
#include "dgtkFrameLayers.h"
#include "dgtkMatte.h"
#include "dgtkMattingSource.h"

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
  return spec;
}

/// Folder of an object's files: its name where that can be one, otherwise its id.
std::string folderOf(const std::string& name, std::uint32_t id)
{
  const bool usable =
    !name.empty() && name.size() <= 128 && name.find_first_of(std::string("/\\\0", 3)) == std::string::npos;
  return "matting_" + (usable ? name : '#' + std::to_string(id));
}

std::vector<std::string> filesOf(const std::string& camera, const std::string& name, std::uint32_t id, int frame)
{
  std::vector<std::string> files;
  for (const char* picture : pictureNames)
  {
    std::string file = WorkPlan::fileName(camera, folderOf(name, id), frame, "png");
    files.push_back(file.insert(file.size() - 4, std::string("_") + picture));
  }
  return files;
}

class MattingLane : public OutputLane
{
public:
  explicit MattingLane(const JobContext& context)
    : Samples(context.plan.request.samples)
    , Pool(context.pool)
  {
    const CameraModel& model = *context.view.model;
    const std::vector<std::string> names = context.queries.stage().objectNames();
    for (const std::uint32_t id : matteObjects(context.plan, context.queries.stage()))
    {
      Output output{ filesOf(context.camera, names[id - 1], id, context.job.frame), {}, Matte(model.width(), Samples) };
      for (int picture = 0; picture < PictureCount; ++picture)
      {
        LayerSpec spec = pictureSpec(picture);
        if (spec.channels == 3)
        {
          spec.name = "color_" + spec.name; // so that the PNG says that it is sRGB
        }
        output.writers.push_back(
          makeLayerWriter("png", context.path(output.names[picture]), spec, model.width(), model.height()));
      }
      this->Outputs.push_back(std::move(output));
    }
  }

  void write(const Band& band) override
  {
    for (std::size_t i = 0; i < this->Outputs.size(); ++i)
    {
      Output& output = this->Outputs[i];
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
      output.matte.addRows(pixels.count.data(), band.rect.height);
      this->Pool.parallelFor(Trimap, [&](int picture) { output.writers[picture]->write(rows[picture]); });
    }
  }

  std::vector<FinishedFile> finish() override
  {
    std::vector<FinishedFile> files;
    for (Output& output : this->Outputs)
    {
      this->writeTrimap(output);
      for (int picture = 0; picture < PictureCount; ++picture)
      {
        FileRecord record = output.writers[picture]->finish();
        record.path = output.names[picture];
        files.push_back({ record, pictureSpec(picture).name });
      }
    }
    return files;
  }

private:
  struct Output
  {
    std::vector<std::string> names;
    std::vector<std::unique_ptr<LayerWriter>> writers;
    Matte matte;
  };

  static void writeTrimap(Output& output)
  {
    const int width = output.matte.width();
    const int height = output.matte.height();
    constexpr int block = 64;
    for (int y = 0; y < height; y += block)
    {
      Rows rows(PixelType::UInt8, 1, width, y, std::min(block, height - y));
      for (int row = y; row < y + rows.height(); ++row)
      {
        output.matte.trimapRow(row, rows.row<std::uint8_t>(row));
      }
      output.writers[Trimap]->write(rows);
    }
  }

  int Samples;
  ThreadPool& Pool;
  std::vector<Output> Outputs;
};

class MattingLayer final : public FrameLayer
{
public:
  LayerInfo info() const override
  {
    return { "matting", { "png" }, "foreground, background, alpha, composite and trimap of the objects of --matte" };
  }
  void check(const WorkPlan& plan, const Stage& stage) const override { matteObjects(plan, stage); }
  std::string needs() const override { return "the names of the objects to cut out (matte)"; }
  std::vector<LayerRecord> specs(const std::string& format) const override
  {
    std::vector<LayerRecord> records;
    for (int picture = 0; picture < PictureCount; ++picture)
    {
      records.push_back({ pictureSpec(picture), format });
    }
    return records;
  }
  std::vector<std::pair<std::string, std::string>> options(const GeneratorRequest& request) const override
  {
    std::string names;
    for (const std::string& name : request.matte)
    {
      names += (names.empty() ? "" : ",") + name;
    }
    return { { "matte", names }, { "matting_samples", std::to_string(request.samples) } };
  }
  std::vector<std::string> files(const WorkPlan& plan, const Stage& stage, const Job& job) const override
  {
    std::vector<std::string> all;
    const std::vector<std::string> names = stage.objectNames();
    for (const std::uint32_t id : matteObjects(plan, stage))
    {
      const std::vector<std::string> own = filesOf(stage.cameraNames()[job.camera], names[id - 1], id, job.frame);
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override
  {
    return std::make_unique<MattingLane>(context);
  }
};
} // namespace

std::shared_ptr<const FrameLayer> makeMattingLayer();
std::shared_ptr<const FrameLayer> makeMattingLayer() { return std::make_shared<MattingLayer>(); }

} // namespace dgtk
