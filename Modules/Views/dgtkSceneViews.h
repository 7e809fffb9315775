// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneViews_h
#define dgtkSceneViews_h

#include "dgtkEditorState.h"
#include "dgtkHandleTool.h"
#include "dgtkSceneView.h"
#include "dgtkViewMeshes.h"
#include "dgtkViewsModule.h"

#include <QByteArrayList>
#include <QWidget>

#include <memory>
#include <vector>

class QHBoxLayout;
class QSettings;
class QSplitter;

namespace dgtk
{

/// The four views of the scene, with splitters between them. A double click shows one alone, another all four.
class DGTKVIEWS_EXPORT SceneViews : public QWidget
{
  Q_OBJECT

public:
  SceneViews(EditorState& state, QWidget* parent);
  ~SceneViews() override;

  SceneView* view(ViewKind kind) const { return this->Views[static_cast<std::size_t>(kind)]; }
  /// The bar above a view, its name at the left.
  QHBoxLayout* title(ViewKind kind) const { return this->Titles[static_cast<std::size_t>(kind)]; }
  const ScenePlaces& places() const { return *this->Places; }
  SceneView* active() const { return this->Active; }
  /// Objects, cameras and lights.
  void frameAll();
  void frameSelected();
  void setStyle(ViewStyle style);
  /// The scene's own lights, or one at each view's eye.
  void setSceneLights(bool on);
  void showGrid(bool on);
  HandleMode handleMode() const { return this->Tool->mode(); }
  void setHandleMode(HandleMode mode);
  void setHandlePivot(HandlePivot pivot);
  void toggleMaximized(SceneView* view);
  /// Where the splitters are, and which view is alone.
  void saveLayout(QSettings& settings) const;
  /// All four, of the same size.
  void resetLayout();
  void restoreLayout(const QSettings& settings);
  /// The perspective view from a camera's place.
  void lookThrough(const CameraDescription& camera);
  /// The window's size and place is known, or another scene was opened: its objects in sight, or what there is.
  void showWhole();

signals:
  void lookedThrough(const CameraDescription& camera);
  void menuAsked(const QPoint& global);
  void failed(const QString& message);
  /// The numbers of a drag, for the status bar.
  void told(const QString& text);

protected:
  void showEvent(QShowEvent* event) override;

private:
  QWidget* makePane(ViewKind kind, const QString& title);
  void refresh();
  /// Where the scene has another than before, its objects are framed from there, also by an edit or its undo. Another
  /// scene is looked at from where views begin.
  void takeUpAxis();
  void frameObjects();
  void activate(SceneView* view);
  bool isAlone(const SceneView* view) const;
  void pick(bool hit, int kind, int index, bool add);
  void connectDrags(SceneView* view);
  void showSelection();
  void showHandles();
  void setHurried(bool on);

  EditorState& State;
  ViewMeshes Meshes;
  std::vector<SceneView*> Views;
  std::vector<QWidget*> Panes;
  std::vector<QHBoxLayout*> Titles;
  QByteArrayList splitters() const;
  void restoreSplitters(const QByteArrayList& states);

  QByteArrayList Divided; ///< where the splitters were when one view became alone
  QSplitter* Columns = nullptr;
  QSplitter* Rows[2] = { nullptr, nullptr };
  SceneView* Active = nullptr;
  std::shared_ptr<const ScenePlaces> Places;
  HandleTool* Tool = nullptr;
  bool WholeWanted = true;
  UpAxis Up = UpAxis::Y;
  std::size_t Opened = 0; ///< SceneDocument::opened() of what is seen
};

} // namespace dgtk

#endif
