// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadCards.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJsonFile.h"
#include "dgtkReadTexts.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <sstream>

// huggingface.co/docs/hub/datasets-cards and datasets-manual-configuration; docs.mlcommons.org/croissant, version 1.0.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

std::string infoOf(const ExportedFrom& source, const std::string& key)
{
  const auto found = source.manifest().info.find(key);
  return found == source.manifest().info.end() ? "" : utf8FromBytes(found->second);
}

/// Keys and values of the YAML head: scalars alone, in the order of the lines; list items with their dash.
std::vector<std::pair<std::string, std::string>> headOf(const std::string& path)
{
  std::istringstream text(readFile(path));
  std::string line;
  if (!std::getline(text, line) || line != "---")
  {
    throw InputError(path, 1, "expected ---");
  }
  std::vector<std::pair<std::string, std::string>> pairs;
  while (std::getline(text, line) && line != "---")
  {
    const std::size_t begin = line.find_first_not_of(" -");
    const std::size_t colon = line.find(": ");
    if (begin != std::string::npos && colon != std::string::npos)
    {
      const std::string value = line.substr(colon + 2);
      pairs.emplace_back(
        line.substr(begin, colon - begin), value[0] == '"' ? Json::parse(value).get<std::string>() : value);
    }
  }
  if (line != "---")
  {
    throw InputError(path, 0, "the head does not end");
  }
  return pairs;
}

std::string valueOf(const std::vector<std::pair<std::string, std::string>>& pairs, const std::string& key)
{
  const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == key; });
  return found == pairs.end() ? "" : found->second;
}

/// Whether a path fits a pattern with one '*', or "**" for any.
bool fits(const std::string& path, const std::string& pattern)
{
  const std::size_t star = pattern.find('*');
  const std::string end = star == std::string::npos ? pattern : pattern.substr(pattern.rfind('*') + 1);
  const std::string begin = pattern.substr(0, star);
  return path.size() >= begin.size() + end.size() && path.compare(0, begin.size(), begin) == 0 &&
         path.compare(path.size() - end.size(), end.size(), end) == 0;
}

void judgeReadme(ExportJudge& judge, const std::string& extension)
{
  const ExportedFrom& source = judge.source();
  const std::string file = "README.md";
  const auto head = useJson(source.path(file), [&] { return headOf(source.path(file)); });
  const std::string license = lower(infoOf(source, "license"));
  const std::string said = valueOf(head, "license");
  const bool right = said == license || (said == "other" && valueOf(head, "license_name") == license);
  judge.holds("licence", file, "license", right, said, license);
  const std::string name = infoOf(source, "name");
  judge.holds("name", file, "pretty_name", name.empty() || valueOf(head, "pretty_name") == name,
    valueOf(head, "pretty_name"), name);
  for (const ExportedFile* one : filesIn(source, "", extension))
  {
    const auto parts = std::count_if(head.begin(), head.end(),
      [&](const auto& pair) { return pair.first == "path" && fits(one->file.path, pair.second); });
    judge.number("parts", "", file, one->file.path, double(parts), 1, 0);
  }
}

void judgeCroissant(ExportJudge& judge, const std::string& extension)
{
  const ExportedFrom& source = judge.source();
  const std::string file = "croissant.json";
  const Json document = readJsonFile(source.path(file));
  useJson(source.path(file),
    [&]
    {
      const auto equals = [&](const char* key, const std::string& expected)
      { judge.holds("croissant", file, key, document.value(key, "") == expected, document.value(key, ""), expected); };
      equals("@type", "sc:Dataset");
      equals("conformsTo", "http://mlcommons.org/croissant/1.0");
      equals("url", infoOf(source, "url"));
      equals("version", infoOf(source, "version"));
      equals("citeAs", infoOf(source, "citation"));
      const std::string address = infoOf(source, "licenseUrl");
      equals("license", address.empty() ? infoOf(source, "license") : address);
      judge.holds("croissant", file, "datePublished", document.count("datePublished") == 0, "a date", "none");
      std::map<std::string, Json> objects;
      std::set<std::string> ids;
      for (const Json& one : document.at("distribution"))
      {
        const std::string id = one.at("@id");
        judge.holds("croissant", file, id, ids.insert(id).second, "an id twice", "each once");
        if (one.at("@type") == "cr:FileObject")
        {
          objects[one.at("contentUrl")] = one;
        }
      }
      for (const Json& one : document.at("distribution"))
      {
        for (const Json& holder : one.value("containedIn", Json::array()))
        {
          judge.holds(
            "croissant", file, one.at("@id"), ids.count(holder.at("@id")) > 0, holder.dump(), "one of its files");
        }
      }
      for (const ExportedFile* one : filesIn(source, "", extension))
      {
        const auto found = objects.find(one->file.path);
        const bool same = found != objects.end() && found->second.at("sha256") == one->file.sha256 &&
                          found->second.at("contentSize") == std::to_string(one->file.bytes) + " B";
        judge.holds("croissant", file, one->file.path, same, found == objects.end() ? "none" : found->second.dump(),
          one->file.sha256);
      }
      for (const Json& records : document.at("recordSet"))
      {
        for (const Json& field : records.at("field"))
        {
          const Json& from = field.at("source");
          const Json& id = (from.count("fileSet") > 0 ? from.at("fileSet") : from.at("fileObject")).at("@id");
          judge.holds("croissant", file, field.at("@id"), ids.count(id) > 0, id.dump(), "one of its files");
        }
      }
    });
}
} // namespace

void judgeCards(ExportJudge& judge, const std::string& extension)
{
  judgeReadme(judge, extension);
  judgeCroissant(judge, extension);
}

SampleDocuments::SampleDocuments(ExportJudge& judge)
  : Judge(judge)
{
  const std::string folder = judge.source().dataset() + '/';
  for (const std::string& part : judge.source().parts())
  {
    const Json cameras = readJsonFile(folder + part + "cameras.json");
    for (Json one : cameras.at("cameras"))
    {
      one["name"] = utf8FromBytes(part) + one.at("name").get<std::string>();
      this->Cameras[{ one.at("name"), one.at("frame") }] = one;
    }
    this->readPoses(part);
  }
}

void SampleDocuments::readPoses(const std::string& part)
{
  const std::string name = part + posesName;
  if (this->Judge.source().listed(name))
  {
    const Json poses = readJsonFile(this->Judge.source().dataset() + '/' + name);
    for (const Json& one : poses.at("poses"))
    {
      this->Poses.emplace(std::make_pair(part, one.at("frame").get<int>()), Json::array()).first->second.push_back(one);
    }
  }
}

void SampleDocuments::judge(
  const std::string& file, const std::string& where, const std::string& camera, int frame, const Json& document) const
{
  const ExportedFrom& source = this->Judge.source();
  const auto known = this->Cameras.find({ utf8FromBytes(camera), frame });
  this->Judge.holds("camera", file, where, known != this->Cameras.end(), camera, "one of cameras.json");
  if (known != this->Cameras.end())
  {
    Json expected = known->second;
    for (auto one = expected.begin(); one != expected.end();)
    {
      const bool isLensFile = one->is_string() && one.key() != "name" && one.key() != "model";
      one = isLensFile ? expected.erase(one) : std::next(one);
    }
    const Json& found = document.at("camera");
    this->Judge.holds("camera", file, where, found == expected, found.dump(), expected.dump());
  }
  const auto poses = this->Poses.find({ source.partOf(camera), frame });
  const Json none = Json::array();
  const Json& expected = poses == this->Poses.end() ? none : poses->second;
  const Json& found = document.at("poses");
  this->Judge.holds("poses", file, where, found == expected, found.dump(), expected.dump());
  const std::string boxes = source.file(camera, frame, "boxes", { "json" });
  const Json listed = boxes.empty() ? Json() : readJsonFile(source.dataset() + '/' + boxes).at("objects");
  this->Judge.holds("boxes", file, where, document.value("boxes", Json()) == listed, "others", boxes);
  const double fps = source.manifest().fps;
  this->Judge.number("time", "s", file, where, document.value("seconds", 0.0), fps > 0 ? frame / fps : 0, 1e-12);
  const bool metric = document.count("metres_per_unit") > 0;
  this->Judge.number(
    "unit", "m", file, where, document.value("metres_per_unit", 0.0), metric ? metresOf(source) : 0, 0);
}

} // namespace dgtk
