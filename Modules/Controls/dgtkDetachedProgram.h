// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDetachedProgram_h
#define dgtkDetachedProgram_h

#include "dgtkControlsModule.h"

#include <QByteArray>
#include <QList>
#include <QString>

namespace dgtk
{

/// Starts a program that outlives this one, whatever ends it: in a session of its own, of lower priority, deaf to
/// SIGHUP, with the usual answers to other signals from its first instruction. It reads nothing, and writes to the
/// descriptor `output`, first of all a line with its number. Returns when it runs: "", or why it does not.
/// `words`: its file and its arguments; `environment`: NAME=VALUE.
DGTKCONTROLS_EXPORT QString startDetached(QList<QByteArray> words, QList<QByteArray> environment, int output);

} // namespace dgtk

#endif
