// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBopAnnotations_h
#define dgtkBopAnnotations_h

// Private to Verification.

#include "dgtkExportJudge.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// scene_gt_coco.json of a scene of BOP (bop_toolkit's scripts/calc_gt_coco.py).
class BopAnnotations
{
public:
  struct Instance
  {
    const ExportedName& picture;
    std::int64_t image = 0;
    std::size_t number = 0; ///< from 0
    int model = 0;
    bool wanted = true; ///< enough of it is visible
  };

  BopAnnotations(ExportJudge& judge, const std::string& file);
  /// An instance of which something is visible; `visible` and `whole` are its masks, rows top to bottom.
  void judge(const Instance& instance, const std::vector<char>& visible, const std::vector<char>& whole);
  /// After all instances: images and categories, and how many annotations there are.
  void judgeRest(const std::string& folder, std::set<int> models, std::size_t instances);

private:
  void judgeOne(const std::string& where, const nlohmann::json& one, const Instance& instance,
    const std::vector<char>& visible, const std::vector<char>& whole);
  ExportJudge& Judge;
  std::string File;
  nlohmann::json Document;
  std::map<std::pair<std::int64_t, std::int64_t>, const nlohmann::json*> Annotations; ///< by image and instance, from 1
};

} // namespace dgtk

#endif
