// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkUsualFolder_h
#define dgtkUsualFolder_h

#include "dgtkControlsModule.h"

#include <QStringList>

class QMimeData;

namespace dgtk
{

/// Where file dialogs begin: where a file of that kind was chosen last; "", the working folder, before the first.
DGTKCONTROLS_EXPORT QString usualFolder(const QString& kind = "scenes");
/// Of a file its folder; a folder (a dataset) itself.
DGTKCONTROLS_EXPORT void rememberFolder(const QString& chosen, const QString& kind = "scenes");
/// Paths of the files and folders on this machine among what is dragged.
DGTKCONTROLS_EXPORT QStringList localFiles(const QMimeData& dragged);
/// Addresses among it that are no files of this machine.
DGTKCONTROLS_EXPORT QStringList foreignAddresses(const QMimeData& dragged);

} // namespace dgtk

#endif
