// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneClipboard_h
#define dgtkSceneClipboard_h

#include <QByteArray>
#include <QObject>
#include <QString>

#include <string>

namespace dgtk
{

class EditorState;

/// The system's clipboard: what is copied in the window goes there, too, for other windows and text editors, and what
/// these have copied since is pasted.
class SceneClipboard : public QObject
{
  Q_OBJECT

public:
  SceneClipboard(EditorState& state, QObject* parent);

  /// Whether there may be something to paste; what is in another program's text shows when it is pasted.
  bool canPaste() const;
  void paste();

signals:
  void changed();
  void told(const QString& text);

private:
  void put();
  void look();
  /// Where the paths of texts start: as in the scene's file.
  std::string folder() const;

  EditorState& State;
  QByteArray Own;         ///< what this window has put there last
  bool IsOffered = false; ///< there are words or a part of a scene
};

} // namespace dgtk

#endif
