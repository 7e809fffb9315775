// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBopPictures_h
#define dgtkBopPictures_h

// Private to Export: the images of a BOP set.

#include "dgtkBopModels.h"

#include "dgtkExportChecks.h"

#include <map>
#include <memory>
#include <string>

namespace dgtk::bop
{

/// A picture's place in the set.
struct Place
{
  std::string split;
  std::string folder; ///< "SPLIT/%06d/"
  int scene = 0;
  int image = 0;
  std::string list(const std::string& name) const { return name + ':' + this->folder; }
  std::string file(const std::string& kind, const std::string& extension = "png") const
  {
    return this->folder + kind + '/' + padded(this->image, 6) + '.' + extension;
  }
  std::string mask(const std::string& kind, std::size_t instance) const
  {
    return this->folder + kind + '/' + padded(this->image, 6) + '_' + padded(int(instance), 6) + ".png";
  }
};

/// What all pictures of a set have in common.
struct Setting
{
  std::map<std::uint32_t, int> idOf;      ///< of an object of its scene: its obj_id
  std::map<int, Eigen::Vector3d> origins; ///< of a model, by obj_id
  double depthScale = 0.1;                ///< millimetres of a code
  OptionValues options;
};

/// Picture, depth and masks; notes "camera", "images", "gt", "info" and "coco" of the place's scene, and "targets".
ExportItem pictureItem(const DatasetView& dataset, const DatasetShot& shot, const Place& place,
  const std::shared_ptr<const Setting>& setting);

} // namespace dgtk::bop

#endif
