// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetCard_h
#define dgtkDatasetCard_h

// Private to Export: what a dataset says of itself where it is published. Texts come from the dataset's `info`; there
// is no date but one that it has.

#include "dgtkExporter.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dgtk::card
{

using Json = nlohmann::ordered_json;

/// A part of the dataset, and the files that it is in: "train", "train-*.tar".
struct Part
{
  std::string name;
  std::string files;
};

/// Throws UsageError for the name of a part that the hub's readers do not take.
void checkParts(const std::vector<std::string>& names, const std::string& format);

/// README.md with a YAML head as Hugging Face's hub reads it: license, name, files of each part. `layout`: Markdown.
/// `pictures`: of all parts and scenes.
std::string readmeText(
  const DatasetView& dataset, std::size_t pictures, const std::vector<Part>& parts, const std::string& layout);

/// croissant.json, Croissant 1.0.
std::string croissantText(const DatasetView& dataset, const Json& distribution, const Json& recordSets);
/// Parts of it. `file`: relative to the document.
Json fileObject(const DatasetFile& file, const std::string& mime);
Json fileSet(const std::string& id, const std::string& mime, const std::string& includes, const Json& containers);
/// Records of the files of a set: `key`, what `pattern` captures of a file's name, and its contents.
Json recordsOf(const std::string& id, const std::string& set, const std::string& mime, const std::string& pattern);
/// "image/png" of "png".
std::string mimeOf(const std::string& extension);

} // namespace dgtk::card

#endif
