// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAutosave_h
#define dgtkAutosave_h

// Private to Widgets.

#include "dgtkEditorState.h"

#include <QStringList>

class QTimer;

namespace dgtk
{

/// Keeps a copy of unsaved work in the user's data folder while the program runs: one file a process, removed at its
/// regular end. What is there without its process was left by a crash.
class Autosave : public QObject
{
  Q_OBJECT

public:
  explicit Autosave(EditorState& state);
  ~Autosave() override;

  /// Copies left behind by processes that are gone.
  static QStringList leftBehind();

private:
  static QString folder();
  static QString file();
  void save();

  EditorState& State;
  QTimer* Timer = nullptr;
  bool Changed = false;
};

} // namespace dgtk

#endif
