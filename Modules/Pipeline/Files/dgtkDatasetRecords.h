// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetRecords_h
#define dgtkDatasetRecords_h

#include "dgtkRunSession.h"
#include "dgtkWorkPlan.h"

#include "dgtkDatasetDocuments.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// Every file that the scene was loaded from, with its hash; paths are relative to `folder`.
std::vector<InputRecord> inputsOf(const Stage& stage, const std::string& folder, RunSession& session);

/// What a manifest says of the request; the numbers of classes, as classesText(), are there if the request gives them.
std::vector<std::pair<std::string, std::string>> requestOf(
  const WorkPlan& plan, const Stage& stage, const std::string& classNumbers);

/// A hash of everything that decides the bytes of a dataset's files: the request, and what the scene was loaded from.
std::string identityOf(
  const WorkPlan& plan, const Stage& stage, const std::string& classNumbers, const std::vector<InputRecord>& inputs);

/// One record for each camera and frame of the plan, cameras first.
std::vector<CameraRecord> cameraRecords(const WorkPlan& plan, const Stage& stage, const std::string& folder,
  const std::map<std::string, std::string>& copies);

/// One record for each object with an id; models are relative to `folder`, or their copies in it.
/// Without their geometry.
std::vector<ObjectRecord> objectRecords(
  const Stage& stage, int frame, const std::string& folder, const std::map<std::string, std::string>& copies);

/// One record for each frame of the plan and object with an id.
std::vector<PoseRecord> poseRecords(const WorkPlan& plan, const Stage& stage);

/// The classes whose numbers the scene fixes.
std::vector<ClassRecord> classRecords(const Stage& stage);

} // namespace dgtk

#endif
