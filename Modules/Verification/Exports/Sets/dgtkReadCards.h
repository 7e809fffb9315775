// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadCards_h
#define dgtkReadCards_h

// Private to Verification: what published datasets say of themselves, and of a picture.

#include "dgtkExportJudge.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <utility>

namespace dgtk
{

/// Compares README.md (the YAML head of Hugging Face's hub) with the dataset's info, and croissant.json (Croissant 1.0)
/// with it and with the hashes of the export's files; all files with `extension` must be among its own, and match the
/// files of one part.
void judgeCards(ExportJudge& judge, const std::string& extension);

/// Documents of the dataset as they stand in its files.
class SampleDocuments
{
public:
  explicit SampleDocuments(ExportJudge& judge);
  /// Compares `camera`, `poses`, `boxes`, `seconds` and `metres_per_unit` of a picture's document.
  void judge(const std::string& file, const std::string& where, const std::string& camera, int frame,
    const nlohmann::json& document) const;

private:
  void readPoses(const std::string& part);
  ExportJudge& Judge;
  std::map<std::pair<std::string, int>, nlohmann::json> Cameras;
  std::map<std::pair<std::string, int>, nlohmann::json> Poses; ///< by part and frame
};

} // namespace dgtk

#endif
