// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAutosave_h
#define dgtkAutosave_h

#include "dgtkEditorState.h"

#include <QStringList>

#include <memory>

class QTimer;

namespace dgtk
{

/// Keeps a copy of unsaved work in the user's data folder while the window lives, removed at its regular end. A locked
/// file beside the copy says that its window lives: the system lets go of the lock when a process ends in any way, so a
/// copy whose lock is free was left by a crash. Process numbers would not tell: they are given again.
class Autosave : public QObject
{
  Q_OBJECT

public:
  explicit Autosave(EditorState& state);
  ~Autosave() override;

  /// Copies left behind by crashes, the newest first.
  static QStringList leftBehind();
  /// A copy that was left behind becomes this window's own: it stays until the work is saved or given up.
  void adopt(const QString& copy);
  static void discard(const QString& copy);
  /// The scene file that was being edited; "" where it had no name yet.
  static QString originOf(const QString& copy);

private:
  class Lock;
  static QString folder();
  void save();
  void forget();

  EditorState& State;
  QString File;
  std::unique_ptr<Lock> Held; ///< from the first copy on
  QTimer* Timer = nullptr;
  bool Changed = false;
};

} // namespace dgtk

#endif
