// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetCard.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkPictureSamples.h"
#include "dgtkTarFile.h"
#include "dgtkText.h"

#include <algorithm>
#include <map>

namespace dgtk
{

namespace
{
constexpr const char* format = "webdataset";
using card::Json;

const IntegerOption& samplesPerShard()
{
  static const IntegerOption row("samples_per_shard", 1000, 1, 1000000, "pictures of a tar, at most");
  return row;
}

const SwitchOption& uniform()
{
  static const SwitchOption row(
    "uniform", "leave out what some pictures lack, so that all samples have the same members");
  return row;
}

struct Sample
{
  std::string key;
  const DatasetShot* shot = nullptr;
  std::vector<samples::Member> members;
};

std::vector<Sample> samplesOf(const DatasetView& dataset, const OptionValues& options)
{
  SafeNames cameras;
  SafeNames layers;
  std::vector<Sample> all;
  std::map<std::string, std::size_t> counts;
  for (const DatasetShot& shot : dataset.shots())
  {
    all.push_back({ samples::keyOf(shot, cameras), &shot, samples::membersOf(dataset, shot, layers, options) });
    for (const samples::Member& member : all.back().members)
    {
      ++counts[member.name];
    }
  }
  for (Sample& sample : all)
  {
    std::vector<samples::Member>& own = sample.members;
    own.erase(
      std::remove_if(own.begin(), own.end(),
        [&](const samples::Member& one) { return uniform().of(options) && counts[one.name] < dataset.shots().size(); }),
      own.end());
  }
  return all;
}

std::string layoutText()
{
  return "Each sample is a picture: the files of a tar with one name up to the first dot. `.json` has camera, poses "
         "and "
         "boxes;\nthe other members are named by the layer that they hold. `objects.json` names objects and "
         "classes.\n\nMade by DGTk.\n";
}

class WebdatasetExporter : public Exporter
{
public:
  std::vector<const OptionRow*> options() const override { return { &samplesPerShard(), &uniform() }; }

  ExportNeeds needs(const OptionValues& options) const override { return { { exported::color().of(options) } }; }

  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    requireEverywhere(dataset, exported::color().of(options), format, { "png" });
    std::vector<std::string> parts;
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      parts.push_back(split.name);
    }
    card::checkParts(parts, format);
    for (const Sample& sample : samplesOf(dataset, options))
    {
      for (const samples::Member& member : sample.members)
      {
        const std::string name = sample.key + '.' + member.name;
        if (name.size() > TarFile::longestName)
        {
          throw UsageError(std::string(format) + ": camera " + quoted(sample.shot->name()) + ": the name " +
                           quoted(name) + " is longer than the " + std::to_string(TarFile::longestName) +
                           " bytes of a name in a tar");
        }
      }
    }
  }

  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    ExportPlan plan;
    plan.conventions = { { "sample", "files of a tar with one name up to the first dot" },
      { "members", uniform().of(options) ? "those that every picture has" : "all" },
      { "values", "the dataset's; .npy in place of .pfm, .flo, .dgd" } };
    const std::vector<Sample> all = samplesOf(dataset, options);
    std::vector<card::Part> parts;
    std::vector<std::string> kinds{ "json" };
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      std::vector<Sample> own;
      std::copy_if(all.begin(), all.end(), std::back_inserter(own),
        [&](const Sample& sample) { return split.holds(*sample.shot); });
      addShards(plan, dataset, split.name, own, options);
      parts.push_back({ split.name, split.name + "-*.tar" });
      for (const Sample& sample : own)
      {
        addKinds(kinds, sample);
      }
    }
    std::sort(kinds.begin(), kinds.end());
    addDocuments(plan, dataset, parts, kinds);
    return plan;
  }

private:
  static void addKinds(std::vector<std::string>& kinds, const Sample& sample)
  {
    for (const samples::Member& member : sample.members)
    {
      if (std::find(kinds.begin(), kinds.end(), member.name) == kinds.end())
      {
        kinds.push_back(member.name);
      }
    }
  }

  static void addShards(ExportPlan& plan, const DatasetView& dataset, const std::string& part,
    const std::vector<Sample>& all, const OptionValues& options)
  {
    const auto most = static_cast<std::size_t>(samplesPerShard().of(options));
    for (std::size_t begin = 0; begin < all.size(); begin += most)
    {
      const std::size_t end = std::min(all.size(), begin + most);
      const std::string name = part + '-' + padded(static_cast<int>(begin / most), 6) + ".tar";
      const std::vector<Sample> own(all.begin() + std::ptrdiff_t(begin), all.begin() + std::ptrdiff_t(end));
      plan.items.push_back({ { name },
        [&dataset, name, own, options](ExportSink& sink) { writeShard(sink, dataset, name, own, options); } });
      for (const Sample& sample : own)
      {
        plan.names.push_back({ sample.shot->name(), sample.shot->frame(), sample.key });
      }
    }
  }

  static void writeShard(ExportSink& sink, const DatasetView& dataset, const std::string& name,
    const std::vector<Sample>& own, const OptionValues& options)
  {
    TarFile tar(sink, name);
    for (const Sample& sample : own)
    {
      samples::Json document = samples::documentOf(dataset, *sample.shot);
      document["members"] = samples::sourcesOf(sample.members);
      tar.add(sample.key + ".json", document.dump() + "\n");
      for (const samples::Member& member : sample.members)
      {
        tar.add(sample.key + '.' + member.name, samples::bytesOf(sink, dataset, member, options));
      }
    }
    sink.note("shards", card::fileObject(tar.finish(), card::mimeOf("tar")).dump());
  }

  static void addDocuments(ExportPlan& plan, const DatasetView& dataset, const std::vector<card::Part>& parts,
    const std::vector<std::string>& kinds)
  {
    plan.documents.push_back(
      { { "objects.json" }, [](ExportSink& sink) { sink.copy("objects.json", "objects.json"); } });
    plan.documents.push_back({ { "README.md" }, [&dataset, parts](ExportSink& sink)
      { sink.write("README.md", card::readmeText(dataset, parts, layoutText())); } });
    plan.documents.push_back({ { "croissant.json" }, [&dataset, kinds](ExportSink& sink)
      {
        Json distribution = Json::array();
        Json containers = Json::array();
        sink.notes("shards",
          [&](const std::string& text)
          {
            distribution.push_back(Json::parse(text));
            containers.push_back({ { "@id", distribution.back().at("@id") } });
          });
        Json records = Json::array();
        for (const std::string& kind : kinds)
        {
          const std::string mime = card::mimeOf(extensionOf('.' + kind));
          const std::string names = kind == "json" ? "*[0-9][0-9][0-9][0-9][0-9][0-9].json" : "*." + kind; // of keys
          distribution.push_back(card::fileSet(kind + "-files", mime, names, containers));
          records.push_back(card::recordsOf(kind, kind + "-files", mime, "^(?:.*/)?([^./]+)\\."));
        }
        sink.write("croissant.json", card::croissantText(dataset, distribution, records));
      } });
  }
};
} // namespace

std::unique_ptr<Exporter> makeWebdatasetExporter() { return std::make_unique<WebdatasetExporter>(); }

} // namespace dgtk
