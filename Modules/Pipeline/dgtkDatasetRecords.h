// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetRecords_h
#define dgtkDatasetRecords_h

#include "dgtkWorkPlan.h"

#include "dgtkDatasetDocuments.h"

#include <string>
#include <vector>

namespace dgtk
{

/// Every file that the scene was loaded from, with its hash; paths are relative to `folder`.
std::vector<InputRecord> inputsOf(const Stage& stage, const std::string& folder);

/// One record for each camera and frame of the plan, cameras first.
std::vector<CameraRecord> cameraRecords(const WorkPlan& plan, const Stage& stage);

/// One record for each object with an id; models are relative to `folder`.
std::vector<ObjectRecord> objectRecords(const Stage& stage, int frame, const std::string& folder);

} // namespace dgtk

#endif
