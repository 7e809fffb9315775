// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReportPage_h
#define dgtkReportPage_h

// Private to Report: the files of Page.

namespace dgtk
{

/// With the places {{css}}, {{title}}, {{data}} and {{js}}, in this order.
extern const char* const reportHtml;
extern const char* const reportCss;
extern const char* const reportJs;

} // namespace dgtk

#endif
