// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkUtf8.h"

namespace dgtk
{

namespace
{
constexpr const char* vocName = "voc";
constexpr std::size_t mostCodes = 254; ///< 255 is void

/// VOC's colours (VOCcode, VOClabelcolormap.m): the bits of a code go to R, G, B in turn, high ones first.
std::string paletteText()
{
  constexpr unsigned codes = 256;
  std::string palette;
  for (unsigned code = 0; code < codes; ++code)
  {
    unsigned color[3] = { 0, 0, 0 };
    for (unsigned bit = 0; bit < 8; ++bit)
    {
      for (unsigned c = 0; c < 3; ++c)
      {
        color[c] |= (code >> (3 * bit + c) & 1U) << (7 - bit);
      }
    }
    for (const unsigned c : color)
    {
      palette += static_cast<char>(c);
    }
  }
  return palette;
}

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : utf8FromBytes(text))
  {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return out;
}

/// Objects with a visible pixel, by id.
std::vector<BoxRecord> seenIn(const DatasetView& dataset, const DatasetShot& shot)
{
  std::vector<BoxRecord> seen;
  for (const BoxRecord& box : dataset.boxes(shot))
  {
    if (box.visible)
    {
      seen.push_back(box);
    }
  }
  return seen;
}

std::string xmlOf(const DatasetShot& shot, const std::string& picture, const std::vector<BoxRecord>& seen)
{
  const auto number = [](double value) { return numbersLine({ value }); };
  std::string text = "<annotation>\n  <folder>JPEGImages</folder>\n  <filename>" + picture + "</filename>\n" +
                     "  <source><database>DGTk</database></source>\n  <size><width>" +
                     std::to_string(shot.camera.width) + "</width><height>" + std::to_string(shot.camera.height) +
                     "</height><depth>3</depth></size>\n  <segmented>1</segmented>\n";
  for (const BoxRecord& box : seen)
  {
    const Eigen::Vector4d& b = *box.visible;
    text += "  <object>\n    <name>" + escaped(namedClass(box.objectClass)) +
            "</name>\n    <pose>Unspecified</pose>\n    <truncated>" +
            std::to_string(int(box.pixelsWhole > box.pixelsAmodal)) + "</truncated>\n    <occluded>" +
            std::to_string(int(box.pixelsVisible < box.pixelsAmodal)) +
            "</occluded>\n    <difficult>0</difficult>\n    <bndbox><xmin>" + number(b[0] + 1) + "</xmin><ymin>" +
            number(b[1] + 1) + "</ymin><xmax>" + number(b[2]) + "</xmax><ymax>" + number(b[3]) +
            "</ymax></bndbox>\n  </object>\n";
  }
  return text + "</annotation>\n";
}

void writeCodes(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& name,
  const std::map<std::uint32_t, unsigned char>& codes)
{
  const std::unique_ptr<RowReader> reader = dataset.open(shot, "objects");
  PngEncoder::Header header;
  header.width = reader->info().width;
  header.height = reader->info().height;
  header.channels = 1;
  header.prediction = PngPrediction::Labels;
  header.palette = paletteText();
  writePng(sink, name, {}, header,
    [&](int y, unsigned char* row)
    {
      const Rows rows = reader->read(1);
      for (int x = 0; x < header.width; ++x)
      {
        const auto found = codes.find(idAt(rows, x, y));
        row[x] = found == codes.end() ? 0 : found->second;
      }
    });
}

class VocExporter : public Exporter
{
public:
  bool joinsScenes() const override { return true; }

  ExportNeeds needs(const OptionValues& options) const override
  {
    return { { exported::color().of(options), "objects", "boxes" } };
  }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    if (dataset.classes().size() > mostCodes)
    {
      throw UsageError(std::string(vocName) + ": more than 254 classes, which its pictures cannot number");
    }
    requireEverywhere(dataset, exported::color().of(options), vocName, { "png" });
    requireEverywhere(dataset, "objects", vocName);
    requireEverywhere(dataset, "boxes", vocName);
    for (const DatasetShot& shot : dataset.shots())
    {
      if (dataset.objects().size() > mostCodes && seenIn(dataset, shot).size() > mostCodes)
      {
        throw UsageError(std::string(vocName) + ": camera " + shot.name() + " sees more than 254 objects at frame " +
                         std::to_string(shot.frame()) + ", which its pictures cannot number");
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "boxes", "pixels from 1, the last one included" },
      { "classes", "codes from 1 in the order of objects.json; 0 is the background" },
      { "objects", "codes from 1 in the order of the annotation" } };
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      const auto item = [&dataset, names = safeNamesOf(dataset), part = split.name, options](
                          const DatasetShot& shot, std::size_t)
      {
        const std::string stem = names->known(shot.name()) + '_' + padded(shot.frame(), 6);
        return named(shot, itemOf(dataset, shot, stem, part, options));
      };
      plan.series.push_back(seriesOf(dataset, shotsIn(dataset, split), item));
      for (const char* kind : { "Main/", "Segmentation/" })
      {
        const std::string name = std::string("ImageSets/") + kind + split.name + ".txt";
        plan.documents.push_back({ { name }, [name, part = split.name](ExportSink& sink)
          {
            const std::unique_ptr<ExportFile> file = sink.open(name);
            sink.notes("stems:" + part, [&](const std::string& stem) { file->write(stem + '\n'); });
            file->finish();
          } });
      }
    }
    return plan;
  }

private:
  static ExportItem itemOf(const DatasetView& dataset, const DatasetShot& shot, const std::string& stem,
    const std::string& part, const OptionValues& options)
  {
    const std::vector<std::string> files{ "JPEGImages/" + stem + ".jpg", "Annotations/" + stem + ".xml",
      "SegmentationClass/" + stem + ".png", "SegmentationObject/" + stem + ".png" };
    return { files, [&dataset, &shot, stem, part, files, options](ExportSink& sink)
      {
        OptionValues jpeg = options; // loaders look for .jpg
        jpeg[exported::imageFormat().name] = "jpg";
        const std::vector<BoxRecord> seen = seenIn(dataset, shot);
        std::map<std::uint32_t, unsigned char> classes;
        std::map<std::uint32_t, unsigned char> objects;
        for (std::size_t i = 0; i < seen.size(); ++i)
        {
          const ObjectRecord* object = dataset.object(seen[i].id);
          for (std::size_t k = 0; object && k < dataset.classes().size(); ++k)
          {
            if (dataset.classes()[k].id == object->classId)
            {
              classes[seen[i].id] = static_cast<unsigned char>(k + 1);
            }
          }
          objects[seen[i].id] = static_cast<unsigned char>(i + 1);
        }
        writePicture(sink, dataset, shot, exported::color().of(options), files[0], jpeg);
        sink.write(files[1], xmlOf(shot, stem + ".jpg", seen));
        writeCodes(sink, dataset, shot, files[2], classes);
        writeCodes(sink, dataset, shot, files[3], objects);
        sink.note("stems:" + part, stem);
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeVocExporter() { return std::make_unique<VocExporter>(); }

} // namespace dgtk
