// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBopModels_h
#define dgtkBopModels_h

// Private to Export: the models of the BOP challenge (bop_toolkit, docs/bop_datasets_format.md).

#include "dgtkExporter.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace dgtk::bop
{

/// A geometry at a scale: what has an obj_id.
struct Model
{
  int id = 0;       ///< from 1
  std::string file; ///< of the dataset
  Eigen::Vector3d scale{ 1, 1, 1 };
  const DatasetView* dataset = nullptr; ///< one that has the file
};

/// Adds the models of these objects to those that are known, and gives the obj_id of each object. Throws UsageError for
/// one that deforms, is sheared, mirrored, or changes its size, and for datasets without files of models.
std::map<std::uint32_t, int> addModels(
  const DatasetView& dataset, const std::vector<std::uint32_t>& objects, std::vector<Model>& models);

/// The middle of the model's box, in object coordinates after the scale, scene units: the origin of BOP's model.
Eigen::Vector3d originOf(const Model& model);

/// models/, models_eval/ and, as a note "models", the model's row of models_info.json.
ExportItem modelItem(const Model& model);

/// The largest distance of two points, exactly.
double diameterOf(const std::vector<Eigen::Vector3d>& points);

} // namespace dgtk::bop

#endif
