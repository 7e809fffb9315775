// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureSamples_h
#define dgtkPictureSamples_h

// Private to Export: a picture with all that the dataset knows of it, as formats of samples have them.

#include "dgtkExporter.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dgtk::samples
{

using Json = nlohmann::ordered_json;

/// Of a picture: the camera's safe name, '_', the frame's six digits.
std::string keyOf(const DatasetShot& shot, const SafeNames& names);

/// A file of the dataset, and what it becomes.
struct Member
{
  enum class Form
  {
    Copy,  ///< the same bytes
    Array, ///< .npy of the values as they are read: unknown flow is NaN, rows from the top
    Ids,   ///< 16-bit gray PNG of object ids
    Jpeg   ///< a picture, with the options' quality
  };
  std::string name; ///< "depth.npy"
  DatasetFile file;
  Form form = Form::Copy;
};

/// Gives what a picture's members are called their safe names; to be asked of all pictures before membersOf().
void addStems(const DatasetView& dataset, const DatasetShot& shot, SafeNames& names);
/// The files of a picture, one of each layer and of each picture that a layer leads to; sorted by name. The layer
/// `boxes` is in documentOf().
std::vector<Member> membersOf(
  const DatasetView& dataset, const DatasetShot& shot, const SafeNames& names, const OptionValues& options);
/// The contents of a member; tells the sink what they are off.
std::string bytesOf(ExportSink& sink, const DatasetView& dataset, const Member& member, const OptionValues& options);

/// The dataset's file of each member, by the member's name.
Json sourcesOf(const std::vector<Member>& members);

/// The picture's entries of cameras.json (without lens files), of poses.json and of the layer `boxes`, its time in
/// seconds, metres of a unit; each where the dataset knows it.
Json documentOf(const DatasetView& dataset, const DatasetShot& shot);

} // namespace dgtk::samples

#endif
