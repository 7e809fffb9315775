// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadCards.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJsonFile.h"
#include "dgtkReadTexts.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <regex>
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

/// The lines of the YAML head.
std::vector<std::string> headLines(const std::string& path)
{
  std::istringstream text(readFile(path));
  std::vector<std::string> lines;
  std::string line;
  if (!std::getline(text, line) || line != "---")
  {
    throw InputError(path, 1, "expected ---");
  }
  while (std::getline(text, line) && line != "---")
  {
    lines.push_back(line);
  }
  if (line != "---")
  {
    throw InputError(path, "the head does not end");
  }
  return lines;
}

/// Keys and values of these lines: scalars alone, in their order; list items without their dash.
std::vector<std::pair<std::string, std::string>> headOf(const std::vector<std::string>& lines)
{
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& line : lines)
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

std::string nameOf(const ExportedFrom& source)
{
  const std::string name = infoOf(source, "name");
  return name.empty() ? "DGTk dataset" : name;
}

/// What stands in the head of every set, but for its licence and its parts.
void judgeHead(ExportJudge& judge, const std::string& file, std::vector<std::string> lines)
{
  const auto isOfLicense = [](const std::string& line) { return line.rfind("license", 0) == 0; };
  lines.erase(std::remove_if(lines.begin(), lines.end(), isOfLicense), lines.end());
  const std::size_t pictures = judge.source().record().names.size();
  const std::string size = pictures < 1000      ? "n<1K"
                           : pictures < 10000   ? "1K<n<10K"
                           : pictures < 100000  ? "10K<n<100K"
                           : pictures < 1000000 ? "100K<n<1M"
                                                : "1M<n<10M";
  const std::vector<std::string> expected{ "tags:", "- synthetic", "size_categories:", "- \"" + size + '"',
    "configs:", "- config_name: default", "  data_files:" };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const std::string found = i + 1 < lines.size() ? lines[i + 1] : "";
    judge.holds("head", file, "line " + std::to_string(i + 2), found == expected[i], found, expected[i]);
  }
  for (std::size_t i = expected.size() + 1; i < std::max(lines.size(), expected.size() + 3); ++i)
  {
    const std::string begin = (i - expected.size()) % 2 == 1 ? "  - split: " : "    path: ";
    const std::string found = i < lines.size() ? lines[i] : "";
    judge.holds("head", file, "line " + std::to_string(i + 1), found.rfind(begin, 0) == 0, found, begin);
  }
}

void judgeReadme(ExportJudge& judge, const std::string& extension)
{
  const ExportedFrom& source = judge.source();
  const std::string file = "README.md";
  const std::vector<std::string> lines = headLines(source.path(file));
  const auto head = useJson(source.path(file), [&] { return headOf(lines); });
  const std::string license = lower(infoOf(source, "license"));
  const std::string said = valueOf(head, "license");
  const bool right = said == license || (said == "other" && valueOf(head, "license_name") == license);
  judge.holds("licence", file, "license", right, said, license);
  const std::string name = nameOf(source);
  judge.holds("name", file, "pretty_name", valueOf(head, "pretty_name") == name, valueOf(head, "pretty_name"), name);
  judgeHead(judge, file, lines);
  for (std::size_t i = 0; i + 1 < head.size(); ++i)
  {
    if (head[i].first == "split")
    {
      const std::string& path = head[i + 1].second;
      const bool own = path == head[i].second + "/**" || path == head[i].second + "-*.tar";
      judge.holds("parts", file, head[i].second, own && head[i + 1].first == "path", path, "files of the part");
    }
  }
  for (const ExportedFile* one : filesIn(source, "", extension))
  {
    const auto parts = std::count_if(head.begin(), head.end(),
      [&](const auto& pair) { return pair.first == "path" && fits(one->file.path, pair.second); });
    judge.exact("parts", "", file, one->file.path, double(parts), 1);
  }
}

/// The words of JSON-LD that Croissant 1.0 prescribes.
bool isCroissantContext(Json context)
{
  Json others{ { "@language", "en" }, { "@vocab", "https://schema.org/" }, { "sc", "https://schema.org/" },
    { "cr", "http://mlcommons.org/croissant/" }, { "rai", "http://mlcommons.org/croissant/RAI/" },
    { "dct", "http://purl.org/dc/terms/" }, { "conformsTo", "dct:conformsTo" } };
  const std::set<std::pair<std::string, std::string>> typed{ { "data", "@json" }, { "examples", "@json" },
    { "dataType", "@vocab" } };
  for (const auto& [name, type] : typed)
  {
    others[name] = { { "@id", "cr:" + name }, { "@type", type } };
  }
  constexpr std::size_t own = 24; // words of Croissant's namespace
  std::size_t words = 0;
  for (const auto& [key, value] : context.items())
  {
    words += value == "cr:" + key;
    others.erase(others.contains(key) && others[key] == value ? key : "");
  }
  return others.empty() && words == own && context.size() == own + 10;
}

std::string mimeOf(const std::string& name)
{
  static const std::map<std::string, std::string> known{ { "png", "image/png" }, { "jpg", "image/jpeg" },
    { "json", "application/json" }, { "txt", "text/plain" }, { "tar", "application/x-tar" },
    { "jsonl", "application/jsonlines" }, { "exr", "image/x-exr" } };
  const auto found = known.find(extensionOf(name));
  return found == known.end() ? "application/octet-stream" : found->second;
}

/// Whether a file or a set of files is described as it is called.
bool isDescribed(const ExportedFrom& source, const Json& one)
{
  const std::string id = one.at("@id");
  const bool isSet = one.at("@type") == "cr:FileSet";
  const std::string files = one.at(isSet ? "includes" : "contentUrl");
  bool right = one.at("name") == id && one.at("encodingFormat") == mimeOf(files);
  if (isSet && one.contains("containedIn")) // members of samples: KIND-files
  {
    const std::string kind = id.substr(0, id.rfind('-'));
    right = right && files == (kind == "json" ? "*[0-9][0-9][0-9][0-9][0-9][0-9].json" : "*." + kind); // of keys
  }
  else if (isSet)
  {
    const std::vector<ExportedName>& names = source.record().names;
    right = right &&
            std::any_of(names.begin(), names.end(), [&](const ExportedName& name) { return fits(name.name, files); });
  }
  return right && (isSet || files == id);
}

/// The key of a file's name, and what the file holds.
bool isOfKeyAndContent(const Json& records, const std::map<std::string, std::string>& mimes)
{
  const std::string id = records.at("@id");
  const Json& fields = records.at("field");
  bool right = records.at("@type") == "cr:RecordSet" && records.at("name") == id && fields.size() == 2;
  for (std::size_t i = 0; right && i < 2; ++i)
  {
    const std::string name = i == 0 ? "key" : "content";
    const Json& source = fields[i].at("source");
    const auto mime = mimes.find(source.at("fileSet").at("@id"));
    const bool image = mime != mimes.end() && mime->second.rfind("image/", 0) == 0;
    const bool text = mime != mimes.end() && (mime->second == "application/json" || mime->second == "text/plain");
    const std::string property = i == 0 ? "filename" : image || text ? "content" : "fullpath";
    right = mime != mimes.end() && fields[i].at("@type") == "cr:Field" && fields[i].at("@id") == id + '/' + name &&
            fields[i].at("name") == name &&
            fields[i].at("dataType") == (i > 0 && image ? "sc:ImageObject" : "sc:Text") &&
            source.at("extract").at("fileProperty") == property;
    if (right && i == 0)
    {
      std::smatch key;
      const std::string file = "folder/camera_000001.depth.npy";
      right = std::regex_search(file, key, std::regex(source.at("transform").at("regex").get<std::string>())) &&
              key.size() == 2 && key[1] == "camera_000001";
    }
  }
  return right;
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
      equals("datePublished", infoOf(source, "datePublished"));
      equals("name", nameOf(source));
      const std::string description = infoOf(source, "description");
      equals("description", description.empty() ? "Rendered pictures and their ground truth" : description);
      const std::string author = infoOf(source, "author");
      judge.holds("croissant", file, "creator",
        author.empty() ? !document.contains("creator") : document.at("creator").at("name") == author, "another",
        author);
      judge.holds("croissant", file, "@context", isCroissantContext(document.at("@context")), "another", "that of 1.0");
      std::map<std::string, Json> objects;
      std::set<std::string> ids;
      std::map<std::string, std::string> mimes; // of sets
      for (const Json& one : document.at("distribution"))
      {
        const std::string id = one.at("@id");
        judge.holds("croissant", file, id, isDescribed(source, one), one.dump(), "as it is called");
        if (one.at("@type") == "cr:FileSet")
        {
          mimes[id] = one.at("encodingFormat");
        }
        judge.holds("croissant", file, id, ids.insert(id).second, "an id twice", "each once");
        if (one.at("@type") == "cr:FileObject")
        {
          objects[one.at("contentUrl")] = one;
        }
      }
      for (const Json& one : document.at("distribution"))
      {
        std::set<std::string> holders;
        for (const Json& holder : one.value("containedIn", Json::array()))
        {
          const std::string id = holder.at("@id");
          judge.holds("croissant", file, one.at("@id"), ids.count(id) > 0 && holders.insert(id).second, id,
            "one of its files, once");
        }
        judge.holds("croissant", file, one.at("@id"), !one.contains("containedIn") || holders.size() == objects.size(),
          std::to_string(holders.size()) + " files", "all");
      }
      for (const ExportedFile* one : filesIn(source, "", extension))
      {
        const auto found = objects.find(one->file.path);
        const bool same = found != objects.end() && found->second.at("sha256") == one->file.sha256 &&
                          found->second.at("contentSize") == std::to_string(one->file.bytes) + " B";
        judge.holds("croissant", file, one->file.path, same, found == objects.end() ? "none" : found->second.dump(),
          one->file.sha256);
      }
      std::set<std::string> used;
      for (const Json& records : document.at("recordSet"))
      {
        judge.holds("croissant", file, records.at("@id"), isOfKeyAndContent(records, mimes), records.dump(),
          "the key and the content of a set's files");
        used.insert(records.at("field").at(0).at("source").at("fileSet").at("@id").get<std::string>());
      }
      judge.exact(
        "croissant", "sets", file, "recordSet", double(document.at("recordSet").size()), double(mimes.size()));
      judge.exact("croissant", "sets", file, "recordSet", double(used.size()), double(mimes.size()));
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
  const double fps = source.manifestOf(camera).fps;
  this->Judge.number("time", "s", file, where, document.value("seconds", 0.0), fps > 0 ? frame / fps : 0, 1e-12);
  const bool metric = document.count("metres_per_unit") > 0;
  this->Judge.exact("unit", "m", file, where, document.value("metres_per_unit", 0.0), metric ? metresOf(source) : 0);
}

} // namespace dgtk
