// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkJsonFile.h"
#include "dgtkReadArchives.h"
#include "dgtkReadCards.h"
#include "dgtkReadTexts.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <cmath>

// github.com/webdataset/webdataset, FAQ and docs: "The WebDataset Format".

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

struct Sample
{
  std::string key;
  const ExportedName* picture = nullptr;
  Json members = Json::object();
  std::set<std::string> found;
};

/// A path without its extension: files of a layer in several formats differ in that alone.
std::string trunkOf(const std::string& path) { return path.substr(0, path.rfind('.')); }

class Archive
{
public:
  Archive(ExportJudge& judge, const SampleDocuments& documents)
    : Judge(judge)
    , Documents(documents)
  {
  }

  void read(const std::string& file)
  {
    this->File = file;
    forTarMembers(this->Judge.source().path(file),
      [&](const std::string& name, const std::string& bytes)
      {
        const std::size_t dot = name.find('.');
        if (name.substr(0, dot) != this->Now.key)
        {
          this->finish();
          this->Now.key = name.substr(0, dot);
          this->Now.picture = pictureOf(this->Judge, file, this->Now.key);
          this->Judge.holds("samples", file, this->Now.key, this->Keys.insert(this->Now.key).second,
            "a sample twice, or torn apart", "each once");
        }
        if (this->Now.picture && dot != std::string::npos)
        {
          this->member(name.substr(dot + 1), bytes);
        }
      });
    this->finish();
  }

  std::size_t samples() const { return this->Keys.size(); }

private:
  void member(const std::string& name, const std::string& bytes)
  {
    const std::string where = this->Now.key + '.' + name;
    this->Judge.holds("members", this->File, where, this->Now.found.insert(name).second, "twice", "once");
    if (name == "json")
    {
      useJson(this->Judge.source().path(this->File),
        [&]
        {
          const Json document = Json::parse(bytes);
          this->Documents.judge(this->File, where, this->Now.picture->camera, this->Now.picture->frame, document);
          this->Now.members = document.at("members");
        });
      return;
    }
    const std::optional<DatasetFile> source =
      this->Judge.source().listed(bytesFromUtf8(this->Now.members.value(name, "")));
    const bool own = source && source->camera == this->Now.picture->camera && source->frame == this->Now.picture->frame;
    this->Judge.holds("members", this->File, where, own, "a file", "one of the picture's, named in its .json");
    if (own)
    {
      this->compare(where, bytes, *source);
    }
  }

  void compare(const std::string& where, const std::string& bytes, const DatasetFile& file)
  {
    const std::string path = this->Judge.source().path(this->File);
    const std::string extension = extensionOf(where);
    if (extension == extensionOf(file.path))
    {
      Sha256 hash;
      hash.update(bytes.data(), bytes.size());
      this->Judge.holds(file.layer, this->File, where, hash.hex() == file.sha256, "other bytes", file.path);
    }
    else if (extension == "npy")
    {
      this->compareValues(where, decodeNpyBytes(path, bytes), file, 0);
    }
    else if (extension == "jpg")
    {
      this->compareValues(where, decodeJpeg(path, bytes), file, this->rounding(file.layer));
    }
    else
    {
      this->compareValues(where, decodeGrayPngBytes(path, bytes), file, 0);
    }
  }

  double rounding(const std::string& layer) const
  {
    const auto& all = this->Judge.source().record().layers;
    const auto found =
      std::find_if(all.begin(), all.end(), [&](const LayerRounding& one) { return one.layer == layer; });
    return found == all.end() ? 0 : found->largest;
  }

  void compareValues(const std::string& where, const DecodedPixels& found, const DatasetFile& file, double tolerance)
  {
    const ExportedFrom& source = this->Judge.source();
    const CameraRecord* camera = source.camera(file.camera, file.frame);
    const PictureFile expected(
      source.dataset(), file.path, camera ? camera->width : found.width, camera ? camera->height : found.height);
    const bool ids = expected.channels() == 3 && found.channels == 1;
    const bool fits = found.width == expected.width() && found.height == expected.height() &&
                      (ids || found.channels == expected.channels());
    this->Judge.holds("size", this->File, where, fits, "another", "the picture's");
    const double level = tolerance > 0 && expected.type() == PixelType::UInt16 ? 257 : 1;
    for (int y = 0; fits && y < found.height; ++y)
    {
      for (int x = 0; x < found.width; ++x)
      {
        for (int c = 0; c < found.channels; ++c)
        {
          const double value = found.at(x, y, c);
          const double want = ids ? expected.id(x, y) : expected.at(x, y, c) / level;
          const bool same = value == want || (std::isnan(value) && std::isnan(want)) ||
                            std::abs(value - want) <= tolerance + (level > 1 ? 0.5 : 0);
          if (!same)
          {
            this->Judge.holds(file.layer, this->File, where + " at " + std::to_string(x) + ", " + std::to_string(y),
              false, numberText(value), numberText(want));
            return;
          }
        }
      }
    }
    this->Judge.holds(file.layer, this->File, where, true, "", "");
  }

  /// All that the dataset has of a picture is there, unless only what all pictures have was asked for.
  void finish()
  {
    if (this->Now.picture)
    {
      std::set<std::string> trunks;
      for (const auto& [name, path] : this->Now.members.items())
      {
        this->Judge.holds("members", this->File, this->Now.key + '.' + name, this->Now.found.count(name) > 0, "none",
          "what the .json names");
        const std::optional<DatasetFile> listed = this->Judge.source().listed(bytesFromUtf8(path.get<std::string>()));
        trunks.insert(listed ? listed->layer + '\n' + trunkOf(listed->path) : "");
      }
      this->Judge.holds("members", this->File, this->Now.key, this->Now.found.count("json") > 0, "no .json", "one");
      const bool all = this->Judge.source().convention("members") == "all";
      for (const DatasetFile& file : this->Judge.source().filesOf(this->Now.picture->camera, this->Now.picture->frame))
      {
        const bool there =
          file.layer == "boxes" || file.layer == "pov" || trunks.count(file.layer + '\n' + trunkOf(file.path)) > 0;
        this->Judge.holds("members", this->File, this->Now.key, there || !all, "no " + file.path, "all files");
      }
    }
    this->Now = {};
  }

  ExportJudge& Judge;
  const SampleDocuments& Documents;
  std::set<std::string> Keys;
  std::string File;
  Sample Now;
};
} // namespace

void readWebdataset(ExportJudge& judge)
{
  const SampleDocuments documents(judge);
  Archive archive(judge, documents);
  for (const ExportedFile* one : filesIn(judge.source(), "", "tar"))
  {
    archive.read(one->file.path);
  }
  judge.exact("samples", "", "README.md", "", double(archive.samples()), double(judge.source().record().names.size()));
  judge.holds("objects.json", "objects.json", "",
    Sha256::ofFile(judge.source().path("objects.json")) == Sha256::ofFile(judge.source().dataset() + "/objects.json"),
    "other bytes", "the dataset's file");
  judgeCards(judge, "tar");
}

} // namespace dgtk
