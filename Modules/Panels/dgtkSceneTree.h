// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneTree_h
#define dgtkSceneTree_h

#include "dgtkEditorState.h"
#include "dgtkPanelsModule.h"

#include <QTreeWidget>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// Objects, cameras and lights by name. What is selected here is selected everywhere; F2 renames.
class DGTKPANELS_EXPORT SceneTree : public QTreeWidget
{
  Q_OBJECT

public:
  SceneTree(EditorState& state, QWidget* parent);
  /// Its name can be typed in its row.
  void rename(const SceneItem& item);

signals:
  void menuAsked(const QPoint& global);

private:
  void refresh();
  void showSelection();
  void takeSelection();
  void takeName(QTreeWidgetItem* row);
  void renameNamed();
  /// The name that is being typed.
  void takeTyped();
  std::vector<std::string> listing() const;

  EditorState& State;
  QTreeWidgetItem* Groups[3];
  std::vector<std::string> Shown;
  std::optional<std::pair<SceneItem, std::string>> Named; ///< what is to be renamed, and how
  bool Busy = false;
};

} // namespace dgtk

#endif
