// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLineEdits_h
#define dgtkTimeLineEdits_h

#include "dgtkEditorState.h"
#include "dgtkTimeLineRows.h"

#include <QObject>

class QMenu;

namespace dgtk
{

/// What the time line does with key frames and sequences: each an edit of the document.
class TimeLineEdits : public QObject
{
  Q_OBJECT

public:
  TimeLineEdits(EditorState& state, QObject* parent);

  /// Of the whole scene at the current frame.
  void makeKey();
  void removeKey();
  void pasteKey(int from, bool move);
  /// The scene's keys of a frame, or those of `item`.
  void dragKeys(const timeline::Drag& drag, SceneItem item);
  /// Its start, or its length.
  void changeBar(SceneItem item, const SequenceBar& bar, bool start);
  /// What can be done with a row's keys and sequence, at the current frame.
  void addActions(QMenu& menu, const timeline::Row& row);

private:
  void edit(const QString& text, const std::function<void(SceneDescription&)>& change);
  void addKeyActions(QMenu& menu, const timeline::Row& row);
  void addInterpolations(QMenu& menu, const timeline::Row& row);
  void addSequences(QMenu& menu, const timeline::Row& row);

  EditorState& State;
};

} // namespace dgtk

#endif
