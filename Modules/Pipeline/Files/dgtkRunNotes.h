// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunNotes_h
#define dgtkRunNotes_h

// Private to Pipeline: what deserves a word about a run although nothing is wrong with its request.

#include "dgtkWorkPlan.h"

#include "dgtkDatasetDocuments.h"

#include <string>
#include <vector>

namespace dgtk
{

/// The layers of which pictures have no file, in one line; "" when there are none.
std::string emptyLine(const std::vector<EmptyRecord>& empty);

/// What deserves a word before the first picture, each line once: scenes without surfaces and cameras whose frustum
/// holds no object's box at any frame of the run; lights whose shadow maps are too coarse for a picture of the run
/// (where it is worst among some of the pictures, evenly spread); what POV-Ray does not show; what layers have to say.
std::vector<std::string> pictureNotes(const WorkPlan& plan, const Stage& stage);

/// A line with the paths of the scene's files, at its start and after colons, relative to the scene's folder, so that
/// it is the same from wherever the scene was named.
std::string placelessLine(const std::string& line, const SceneDescription& scene);

} // namespace dgtk

#endif
