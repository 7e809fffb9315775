// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportChecks_h
#define dgtkReportChecks_h

// Private to Report: documents that stand beside a dataset.

#include "dgtkReport.h"
#include "dgtkReportTally.h"

namespace dgtk
{

/// What a verification found; null where there is none. Throws InputError for a file that is no report of one.
ReportJson verificationOf(const ReportRequest& request);
/// Rounding that each export states. Throws InputError.
ReportJson exportsOf(const ReportRequest& request);
/// What sampling kept and refused; null where there is no such document. Throws InputError for one that is not JSON.
ReportJson samplesOf(const ReportRequest& request);

} // namespace dgtk

#endif
