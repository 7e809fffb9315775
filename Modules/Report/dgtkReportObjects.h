// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportObjects_h
#define dgtkReportObjects_h

#include "dgtkReportPictures.h"

namespace dgtk
{

/// Objects and classes with the pictures and pixels in which they are seen, and the distributions of what lists of
/// boxes say of objects: their size in the picture and their visible share. `objects`, `classes`: pixels by picture.
ReportJson objectsSeen(const ReportSource& source, const std::map<std::size_t, IdTally>& objects,
  const std::map<std::size_t, IdTally>& classes, std::vector<std::string>& notes);

/// Names for the page to read ids by: of the scenes whose pictures are shown.
ReportJson namesOf(const ReportSource& source);

} // namespace dgtk

#endif
