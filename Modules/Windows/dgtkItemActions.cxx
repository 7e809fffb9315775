// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMainWindow.h"

#include "dgtkEditorState.h"
#include "dgtkSceneClipboard.h"
#include "dgtkSceneTree.h"
#include "dgtkSceneViews.h"
#include "dgtkTimeLineCells.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>

namespace dgtk
{

// What is done with selected items, in the Edit menu and in their context menu.

void MainWindow::makeItemActions(QMenu* menu)
{
  auto* group = new QActionGroup(this);
  const auto addMode = [&](const char* name, const QString& text, const char* key, HandleMode mode)
  {
    QAction* const action = group->addAction(this->addAction(menu, name, text, QKeySequence(key)));
    action->setCheckable(true);
    action->setChecked(mode == this->Views->handleMode());
    connect(action, &QAction::triggered, this, [this, mode] { this->Views->setHandleMode(mode); });
  };
  menu->addSeparator();
  addMode("move", tr("&Move"), "1", HandleMode::Move);
  addMode("rotate", tr("Rotat&e"), "2", HandleMode::Rotate);
  addMode("scale", tr("&Scale"), "3", HandleMode::Scale);
  QAction* const origin = this->addAction(menu, "handlesAtOrigin", tr("&Handles at the origin"), QKeySequence("O"));
  origin->setCheckable(true);
  origin->setToolTip(tr("Rotates and scales about the object's origin; otherwise about the middle of its box"));
  connect(origin, &QAction::toggled, this,
    [this](bool on) { this->Views->setHandlePivot(on ? HandlePivot::Origin : HandlePivot::Center); });
  menu->addSeparator();
  const auto add = [&](const char* name, const QString& text, const QKeySequence& keys)
  { return this->addAction(menu, name, text, keys); };
  connect(add("rename", tr("Re&name"), QKeySequence("F2")), &QAction::triggered, this, &MainWindow::rename);
  connect(add("keyFrame", tr("Make &key frame"), QKeySequence("K")), &QAction::triggered, this,
    [this] { this->findChild<TimeLineCells*>("timeLineCells")->makeKey(); });
  connect(
    add("preview", tr("Pre&view the camera"), QKeySequence("P")), &QAction::triggered, this, &MainWindow::preview);
  connect(add("properties", tr("Pr&operties"), QKeySequence("Alt+Return")), &QAction::triggered, this,
    &MainWindow::showProperties);
}

void MainWindow::refreshItemActions()
{
  const SceneItems& selection = this->State->selection();
  for (const char* name : { "cut", "copy", "duplicate", "delete", "frameSelected", "rename", "properties" })
  {
    this->findChild<QAction*>(name)->setEnabled(!selection.empty());
  }
  bool camera = false;
  for (const SceneItem& item : selection)
  {
    camera = camera || item.kind == SceneItem::Kind::Camera;
  }
  this->findChild<QAction*>("preview")->setEnabled(camera);
  this->findChild<QAction*>("paste")->setEnabled(this->Copied->canPaste());
}

void MainWindow::rename()
{
  if (!this->State->selection().empty())
  {
    auto* dock = this->findChild<QDockWidget*>("treeDock");
    dock->show();
    dock->raise();
    this->findChild<SceneTree*>("sceneTree")->rename(this->State->selection().front());
  }
}

void MainWindow::remove()
{
  const SceneDescription& scene = this->State->scene();
  const SceneItems family = withChildren(scene, this->State->selection()); // those that hang on it are the last ones
  QStringList hanging;
  for (std::size_t i = this->State->selection().size(); i < family.size(); ++i)
  {
    hanging << toText(itemName(scene, family[i]));
  }
  const std::size_t before = scene.objects.size();
  this->State->remove();
  const std::size_t gone = before - this->State->scene().objects.size();
  if (gone != 0 && !hanging.isEmpty())
  {
    constexpr int mostNamed = 20;
    const QString more = hanging.size() > mostNamed ? QStringLiteral(", ...") : QString();
    this->note(tr("%1 objects deleted, among them what hangs on what was selected: %2")
                 .arg(QString::number(gone), QStringList(hanging.mid(0, mostNamed)).join(", ") + more));
  }
}

void MainWindow::showProperties()
{
  auto* dock = this->findChild<QDockWidget*>("propertiesDock");
  dock->show();
  dock->raise();
  // A page that has just been replaced waits to be deleted.
  const QList<QLineEdit*> names = dock->findChildren<QLineEdit*>("name");
  if (!names.isEmpty())
  {
    names.last()->setFocus();
    names.last()->selectAll();
  }
}

void MainWindow::preview()
{
  for (const SceneItem& item : this->State->selection())
  {
    if (item.kind == SceneItem::Kind::Camera)
    {
      this->Views->lookThrough(this->State->scene().cameras[item.index]);
      return;
    }
  }
}

void MainWindow::showContextMenu(const QPoint& global)
{
  QMenu menu(this);
  menu.setObjectName("contextMenu");
  const auto add = [&](std::initializer_list<const char*> names)
  {
    for (const char* name : names)
    {
      menu.addAction(this->findChild<QAction*>(name));
    }
    menu.addSeparator();
  };
  if (this->State->selection().empty())
  {
    add({ "import", "camera", "light", "paste" });
    add({ "keyFrame", "frameAll" });
  }
  else
  {
    if (this->findChild<QAction*>("preview")->isEnabled())
    {
      add({ "preview" });
    }
    add({ "move", "rotate", "scale" });
    add({ "rename", "keyFrame", "frameSelected" });
    add({ "cut", "copy", "paste", "duplicate", "delete" });
    add({ "properties" });
  }
  menu.exec(global);
}

} // namespace dgtk
