// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportSpace_h
#define dgtkReportSpace_h

// Private to Report: cameras and objects seen from above, and from where objects are seen.

#include "dgtkReportPictures.h"

namespace dgtk
{

/// Cameras and objects of at most `mostScenes` scenes, their places at some frames.
ReportJson plansOf(const ReportSource& source);

/// From which directions objects are seen, in their own axes. `ids`: pixels of objects by picture; where a picture has
/// none, all of its objects count.
ReportJson viewpointsOf(const ReportSource& source, const std::map<std::size_t, IdTally>& ids);

} // namespace dgtk

#endif
