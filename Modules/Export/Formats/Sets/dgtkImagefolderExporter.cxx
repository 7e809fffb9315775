// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetCard.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportPng.h"
#include "dgtkExportSeries.h"
#include "dgtkPictureSamples.h"
#include "dgtkUtf8.h"

namespace dgtk
{

namespace
{
constexpr const char* imagefolderName = "imagefolder";
using card::Json;

/// What is seen, as the hub's detection sets have it: lists of one length, boxes [x, y, width, height] in pixels.
Json seenObjects(const DatasetView& dataset, const DatasetShot& shot)
{
  Json seen{ { "id", Json::array() }, { "bbox", Json::array() }, { "category", Json::array() } };
  for (const BoxRecord& box : dataset.boxes(shot))
  {
    if (box.visible)
    {
      const Eigen::Vector4d& edges = *box.visible;
      seen["id"].push_back(box.id);
      seen["bbox"].push_back({ edges[0], edges[1], edges[2] - edges[0], edges[3] - edges[1] });
      seen["category"].push_back(utf8FromBytes(box.objectClass));
    }
  }
  return seen;
}

std::string metadataLine(const DatasetView& dataset, const DatasetShot& shot, const std::string& file)
{
  Json line{ { "file_name", file } };
  line.update(samples::documentOf(dataset, shot));
  if (!dataset.file(shot, "boxes", { "json" }).empty())
  {
    line["objects"] = seenObjects(dataset, shot);
  }
  return line.dump() + "\n";
}

class ImagefolderExporter : public Exporter
{
public:
  bool joinsScenes() const override { return true; }

  ExportNeeds needs(const OptionValues& options) const override { return { { exported::color().of(options) } }; }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireEverywhere(dataset, exported::color().of(options), imagefolderName, { "png" });
    std::vector<std::string> parts;
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      parts.push_back(split.name);
    }
    card::checkParts(parts, imagefolderName);
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "metadata", "file_name, camera, poses and boxes as the dataset's documents have them" },
      { "objects", "bbox: [x, y, width, height], pixels from the image's corner" } };
    std::vector<card::Part> parts;
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      const auto item = [&dataset, names = safeNamesOf(dataset), part = split.name, options](
                          const DatasetShot& shot, std::size_t)
      { return named(shot, picture(dataset, shot, part, samples::keyOf(shot, *names), options)); };
      plan.series.push_back(seriesOf(dataset, shotsIn(dataset, split), item));
      plan.documents.push_back(metadata(split.name));
      parts.push_back({ split.name, split.name + "/**" });
    }
    plan.documents.push_back({ { "README.md" }, [&dataset, parts](ExportSink& sink)
      {
        std::size_t pictures = 0;
        for (const card::Part& part : parts)
        {
          sink.notes("lines:" + part.name, [&](const std::string&) { ++pictures; });
        }
        sink.write(
          "README.md", card::readmeText(dataset, pictures, parts,
                         "Pictures, and a `metadata.jsonl` in each folder: a line a picture with its camera, poses and "
                         "boxes.\n\nMade by DGTk.\n"));
      } });
    plan.documents.push_back(croissant(dataset, parts, pictureExtension(options)));
    return plan;
  }

private:
  static ExportItem picture(const DatasetView& dataset, const DatasetShot& shot, const std::string& part,
    const std::string& key, const OptionValues& options)
  {
    const std::string file = key + '.' + pictureExtension(options);
    const std::string path = part + '/' + file;
    return { { path }, [&dataset, &shot, part, file, path, options](ExportSink& sink)
      {
        writePicture(sink, dataset, shot, exported::color().of(options), path, options);
        sink.note("lines:" + part, metadataLine(dataset, shot, file));
      } };
  }

  static ExportItem metadata(const std::string& part)
  {
    const std::string path = part + "/metadata.jsonl";
    return { { path }, [part, path](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> file = sink.open(path);
        sink.notes("lines:" + part, [&](const std::string& line) { file->write(line); });
        sink.note("metadata", card::fileObject(file->finish(), card::mimeOf("jsonl")).dump());
      } };
  }

  static ExportItem croissant(
    const DatasetView& dataset, const std::vector<card::Part>& parts, const std::string& extension)
  {
    return { { "croissant.json" }, [&dataset, parts, extension](ExportSink& sink)
      {
        Json distribution = Json::array();
        Json records = Json::array();
        sink.notes("metadata", [&](const std::string& text) { distribution.push_back(Json::parse(text)); });
        const std::string mime = card::mimeOf(extension);
        for (const card::Part& part : parts)
        {
          const std::string set = part.name + "-pictures";
          distribution.push_back(card::fileSet(set, mime, part.name + "/*." + extension, Json::array()));
          records.push_back(card::recordsOf(part.name, set, mime, "^(?:.*/)?([^./]+)\\."));
        }
        sink.write("croissant.json", card::croissantText(dataset, distribution, records));
      } };
  }
};
} // namespace

std::unique_ptr<Exporter> makeImagefolderExporter() { return std::make_unique<ImagefolderExporter>(); }

} // namespace dgtk
