// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetCard.h"

#include "dgtkError.h"
#include "dgtkExportChecks.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <map>

namespace dgtk::card
{

namespace
{
std::string infoOf(const DatasetView& dataset, const std::string& key)
{
  const auto found = dataset.manifest().info.find(key);
  return found == dataset.manifest().info.end() ? "" : utf8FromBytes(found->second);
}

std::string nameOf(const DatasetView& dataset)
{
  const std::string name = infoOf(dataset, "name");
  return name.empty() ? "DGTk dataset" : name;
}

std::string line(const std::string& key, const std::string& text) { return key + ": " + quotedText(text) + "\n"; }

/// Licences that the hub knows by SPDX's names in lower case.
bool isKnownLicense(const std::string& name)
{
  static const std::vector<std::string> known{ "apache-2.0", "bsd", "bsd-2-clause", "bsd-3-clause", "cc", "cc-by-2.0",
    "cc-by-3.0", "cc-by-4.0", "cc-by-nc-2.0", "cc-by-nc-3.0", "cc-by-nc-4.0", "cc-by-nc-nd-3.0", "cc-by-nc-nd-4.0",
    "cc-by-nc-sa-2.0", "cc-by-nc-sa-3.0", "cc-by-nc-sa-4.0", "cc-by-nd-4.0", "cc-by-sa-3.0", "cc-by-sa-4.0", "cc0-1.0",
    "gpl-2.0", "gpl-3.0", "lgpl-3.0", "mit", "mpl-2.0", "odbl", "odc-by", "pddl", "unlicense" };
  return std::find(known.begin(), known.end(), name) != known.end();
}

std::string licenseLines(const DatasetView& dataset)
{
  const std::string license = infoOf(dataset, "license");
  const std::string address = infoOf(dataset, "licenseUrl");
  if (license.empty() && address.empty())
  {
    return {};
  }
  if (isKnownLicense(lower(license)))
  {
    return line("license", lower(license));
  }
  return line("license", "other") + (license.empty() ? "" : line("license_name", lower(license))) +
         (address.empty() ? "" : line("license_link", address));
}

std::string sizeOf(std::size_t pictures)
{
  return pictures < 1000      ? "n<1K"
         : pictures < 10000   ? "1K<n<10K"
         : pictures < 100000  ? "10K<n<100K"
         : pictures < 1000000 ? "100K<n<1M"
                              : "1M<n<10M";
}

/// The JSON-LD context that Croissant 1.0 prescribes.
Json context()
{
  Json terms{ { "@language", "en" }, { "@vocab", "https://schema.org/" }, { "sc", "https://schema.org/" },
    { "cr", "http://mlcommons.org/croissant/" }, { "rai", "http://mlcommons.org/croissant/RAI/" },
    { "dct", "http://purl.org/dc/terms/" }, { "conformsTo", "dct:conformsTo" } };
  for (const char* own : { "citeAs", "column", "extract", "field", "fileProperty", "fileObject", "fileSet", "format",
         "includes", "isLiveDataset", "jsonPath", "key", "md5", "parentField", "path", "recordSet", "references",
         "regex", "repeated", "replace", "separator", "source", "subField", "transform" })
  {
    terms[own] = std::string("cr:") + own;
  }
  terms["data"] = { { "@id", "cr:data" }, { "@type", "@json" } };
  terms["examples"] = { { "@id", "cr:examples" }, { "@type", "@json" } };
  terms["dataType"] = { { "@id", "cr:dataType" }, { "@type", "@vocab" } };
  return terms;
}

void addText(Json& document, const char* key, const std::string& text)
{
  if (!text.empty())
  {
    document[key] = text;
  }
}
} // namespace

void checkParts(const std::vector<std::string>& names, const std::string& format)
{
  for (const std::string& name : names)
  {
    if (name.find('-') != std::string::npos)
    {
      throw UsageError("split: parts of " + format + " have names of letters, digits and _, found " + quoted(name));
    }
  }
}

std::string readmeText(
  const DatasetView& dataset, std::size_t pictures, const std::vector<Part>& parts, const std::string& layout)
{
  std::string text = "---\n" + licenseLines(dataset) + line("pretty_name", nameOf(dataset));
  text += "tags:\n- synthetic\nsize_categories:\n- " + quotedText(sizeOf(pictures)) + "\n";
  text += "configs:\n- config_name: default\n  data_files:\n";
  for (const Part& part : parts)
  {
    text += "  - split: " + quotedText(part.name) + "\n    path: " + quotedText(part.files) + "\n";
  }
  text += "---\n\n# " + nameOf(dataset) + "\n\n";
  for (const char* key : { "description", "author", "version", "url", "license", "licenseUrl" })
  {
    const std::string value = infoOf(dataset, key);
    text += value.empty() ? "" : std::string(key) + ": " + value + "\n\n";
  }
  text += layout;
  const std::string citation = infoOf(dataset, "citation");
  return text + (citation.empty() ? "" : "\n## Citation\n\n" + citation + "\n");
}

std::string croissantText(const DatasetView& dataset, const Json& distribution, const Json& recordSets)
{
  Json document{ { "@context", context() }, { "@type", "sc:Dataset" },
    { "conformsTo", "http://mlcommons.org/croissant/1.0" }, { "name", nameOf(dataset) } };
  const std::string description = infoOf(dataset, "description");
  document["description"] = description.empty() ? "Rendered pictures and their ground truth" : description;
  const std::string address = infoOf(dataset, "licenseUrl");
  addText(document, "license", address.empty() ? infoOf(dataset, "license") : address);
  addText(document, "url", infoOf(dataset, "url"));
  addText(document, "version", infoOf(dataset, "version"));
  addText(document, "citeAs", infoOf(dataset, "citation"));
  addText(document, "datePublished", infoOf(dataset, "datePublished"));
  if (!infoOf(dataset, "author").empty())
  {
    document["creator"] = { { "@type", "sc:Person" }, { "name", infoOf(dataset, "author") } };
  }
  document["distribution"] = distribution;
  document["recordSet"] = recordSets;
  return document.dump(2) + "\n";
}

Json fileObject(const DatasetFile& file, const std::string& mime)
{
  return { { "@type", "cr:FileObject" }, { "@id", file.path }, { "name", file.path }, { "contentUrl", file.path },
    { "contentSize", std::to_string(file.bytes) + " B" }, { "encodingFormat", mime }, { "sha256", file.sha256 } };
}

Json fileSet(const std::string& id, const std::string& mime, const std::string& includes, const Json& containers)
{
  Json set{ { "@type", "cr:FileSet" }, { "@id", id }, { "name", id } };
  if (!containers.empty())
  {
    set["containedIn"] = containers;
  }
  set["encodingFormat"] = mime;
  set["includes"] = includes;
  return set;
}

Json recordsOf(const std::string& id, const std::string& set, const std::string& mime, const std::string& pattern)
{
  const bool image = mime.rfind("image/", 0) == 0;
  const bool text = mime == "application/json" || mime == "text/plain";
  const Json key{ { "@type", "cr:Field" }, { "@id", id + "/key" }, { "name", "key" }, { "dataType", "sc:Text" },
    { "source", { { "fileSet", { { "@id", set } } }, { "extract", { { "fileProperty", "filename" } } },
                  { "transform", { { "regex", pattern } } } } } };
  const Json content{ { "@type", "cr:Field" }, { "@id", id + "/content" }, { "name", "content" },
    { "dataType", image ? "sc:ImageObject" : "sc:Text" },
    { "source", { { "fileSet", { { "@id", set } } },
                  { "extract", { { "fileProperty", image || text ? "content" : "fullpath" } } } } } };
  return { { "@type", "cr:RecordSet" }, { "@id", id }, { "name", id }, { "field", Json::array({ key, content }) } };
}

std::string mimeOf(const std::string& extension)
{
  static const std::map<std::string, std::string> known{ { "png", "image/png" }, { "jpg", "image/jpeg" },
    { "json", "application/json" }, { "txt", "text/plain" }, { "tar", "application/x-tar" },
    { "jsonl", "application/jsonlines" }, { "exr", "image/x-exr" } };
  const auto found = known.find(extension);
  return found == known.end() ? "application/octet-stream" : found->second;
}

} // namespace dgtk::card
