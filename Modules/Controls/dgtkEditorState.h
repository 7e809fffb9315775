// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEditorState_h
#define dgtkEditorState_h

#include "dgtkControlsModule.h"
#include "dgtkSceneDocument.h"

#include <QObject>
#include <QString>

#include <functional>
#include <string>
#include <vector>

namespace dgtk
{

inline QString toText(const std::string& text) { return QString::fromStdString(text); }

/// What the parts of the window share: the document, what is selected, the current frame and the clipboard.
class DGTKCONTROLS_EXPORT EditorState : public QObject
{
  Q_OBJECT

public:
  explicit EditorState(QObject* parent);

  SceneDocument& document() { return this->Document; }
  const SceneDescription& scene() const { return this->Document.scene(); }

  const SceneItems& selection() const { return this->Selection; }
  bool isSelected(const SceneItem& item) const;
  void select(const SceneItems& items);
  /// Adds the item, or takes it away when it is selected.
  void toggle(const SceneItem& item);
  void selectAll() { this->select(this->scene().items()); }

  int frame() const { return this->Frame; }
  void setFrame(int frame);

  /// Runs an edit. When it throws, failed() tells why, the document is as before, and the result is false.
  bool attempt(const std::function<void()>& edit);

  /// What is being typed is taken: before the scene is saved, rendered or changed otherwise.
  void finishTyping() { emit this->typingEnds(); }

  void cut();
  void copy();
  void paste();
  void duplicate();
  void remove();
  bool canPaste() const { return !this->Clipboard.items().empty(); }
  const SceneDescription& clipboard() const { return this->Clipboard; }
  /// What another window has copied.
  void pasteItems(const SceneDescription& part);

signals:
  void changed();
  void selectionChanged();
  void frameChanged(int frame);
  void typingEnds();
  void copied();
  void failed(const QString& message);

private:
  void afterChange();
  void rememberNames();
  /// What is selected, and what hangs on it.
  SceneDescription selectedFamilies() const;

  SceneDocument Document;
  SceneItems Selection;
  std::vector<std::string> SelectedNames;
  std::size_t Counts[3] = { 0, 0, 0 };
  int Frame = 0;
  SceneDescription Clipboard;
};

} // namespace dgtk

#endif
