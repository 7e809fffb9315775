// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetCard.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportChecks.h"
#include "dgtkExportSeries.h"
#include "dgtkPictureSamples.h"
#include "dgtkTarFile.h"

#include <algorithm>
#include <map>
#include <memory>

namespace dgtk
{

namespace
{
constexpr const char* webdatasetName = "webdataset";
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

/// What the members of all samples are called. The samples themselves are made when they are written.
class Samples
{
public:
  Samples(const DatasetView& dataset, const OptionValues& options)
    : Dataset(dataset)
    , Options(options)
    , Cameras(safeNamesOf(dataset))
  {
    for (const DatasetShot& shot : dataset.shots())
    {
      samples::addStems(dataset, shot, this->Stems);
      for (const samples::Member& member : samples::membersOf(dataset, shot, this->Stems, options))
      {
        ++this->Counts[member.name];
      }
    }
  }

  const DatasetView& dataset() const { return this->Dataset; }
  const OptionValues& options() const { return this->Options; }
  std::string keyOf(const DatasetShot& shot) const { return samples::keyOf(shot, *this->Cameras); }
  std::vector<samples::Member> membersOf(const DatasetShot& shot) const
  {
    std::vector<samples::Member> own = samples::membersOf(this->Dataset, shot, this->Stems, this->Options);
    own.erase(std::remove_if(own.begin(), own.end(),
                [&](const samples::Member& one) { return uniform().of(this->Options) && !this->isEverywhere(one); }),
      own.end());
    return own;
  }

private:
  bool isEverywhere(const samples::Member& member) const
  {
    return this->Counts.at(member.name) == this->Dataset.shots().size();
  }
  const DatasetView& Dataset;
  OptionValues Options;
  std::shared_ptr<const SafeNames> Cameras;
  SafeNames Stems;
  std::map<std::string, std::size_t> Counts; ///< of a member's name: pictures that have it
};

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
    requireEverywhere(dataset, exported::color().of(options), webdatasetName, { "png" });
    std::vector<std::string> parts;
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      parts.push_back(split.name);
    }
    card::checkParts(parts, webdatasetName);
    const Samples all(dataset, options);
    for (const DatasetShot& shot : dataset.shots())
    {
      for (const samples::Member& member : all.membersOf(shot))
      {
        const std::string name = all.keyOf(shot) + '.' + member.name;
        if (name.size() > TarFile::longestName)
        {
          throw UsageError(std::string(webdatasetName) + ": camera " + quoted(shot.name()) + ": the name " +
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
    const auto all = std::make_shared<const Samples>(dataset, options);
    std::size_t pictures = 0;
    std::vector<card::Part> parts;
    std::vector<std::string> kinds{ "json" };
    for (const DatasetSplit& split : splitsOf(dataset, options, "train"))
    {
      const std::vector<std::uint32_t> own = shotsIn(dataset, split);
      addShards(plan, all, split.name, own);
      pictures += own.size();
      parts.push_back({ split.name, split.name + "-*.tar" });
      for (const std::uint32_t shot : own)
      {
        addKinds(kinds, all->membersOf(dataset.shots()[shot]));
      }
    }
    std::sort(kinds.begin(), kinds.end());
    addDocuments(plan, dataset, pictures, parts, kinds);
    return plan;
  }

private:
  static void addKinds(std::vector<std::string>& kinds, const std::vector<samples::Member>& members)
  {
    for (const samples::Member& member : members)
    {
      if (std::find(kinds.begin(), kinds.end(), member.name) == kinds.end())
      {
        kinds.push_back(member.name);
      }
    }
  }

  static void addShards(ExportPlan& plan, const std::shared_ptr<const Samples>& all, const std::string& part,
    const std::vector<std::uint32_t>& shots)
  {
    const auto most = static_cast<std::size_t>(samplesPerShard().of(all->options()));
    plan.series.push_back({ (shots.size() + most - 1) / most, [all, part, shots, most](std::size_t i)
      {
        const std::string name = part + '-' + padded(static_cast<int>(i), 6) + ".tar";
        const auto begin = shots.begin() + std::ptrdiff_t(i * most);
        const std::vector<std::uint32_t> own(begin, begin + std::ptrdiff_t(std::min(most, shots.size() - i * most)));
        return ExportItem{ { name }, [all, name, own](ExportSink& sink) { writeShard(sink, *all, name, own); } };
      } });
    plan.series.push_back(namesOf(all->dataset(), shots, [all](const DatasetShot& shot) { return all->keyOf(shot); }));
  }

  static void writeShard(
    ExportSink& sink, const Samples& all, const std::string& name, const std::vector<std::uint32_t>& own)
  {
    TarFile tar(sink, name);
    for (const std::uint32_t i : own)
    {
      const DatasetShot& shot = all.dataset().shots()[i];
      const std::vector<samples::Member> members = all.membersOf(shot);
      samples::Json document = samples::documentOf(all.dataset(), shot);
      document["members"] = samples::sourcesOf(members);
      tar.add(all.keyOf(shot) + ".json", document.dump() + "\n");
      for (const samples::Member& member : members)
      {
        tar.add(all.keyOf(shot) + '.' + member.name, samples::bytesOf(sink, all.dataset(), member, all.options()));
      }
    }
    sink.note("shards", card::fileObject(tar.finish(), card::mimeOf("tar")).dump());
  }

  static void addDocuments(ExportPlan& plan, const DatasetView& dataset, std::size_t pictures,
    const std::vector<card::Part>& parts, const std::vector<std::string>& kinds)
  {
    plan.documents.push_back(
      { { "objects.json" }, [](ExportSink& sink) { sink.copy("objects.json", "objects.json"); } });
    plan.documents.push_back({ { "README.md" }, [&dataset, pictures, parts](ExportSink& sink)
      { sink.write("README.md", card::readmeText(dataset, pictures, parts, layoutText())); } });
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
          const std::string mime = card::mimeOf(kind.substr(kind.rfind('.') + 1));
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
