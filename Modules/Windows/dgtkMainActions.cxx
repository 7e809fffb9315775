// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMainWindow.h"

#include "dgtkCameraArrayDialog.h"
#include "dgtkEditorIcons.h"
#include "dgtkEditorLog.h"
#include "dgtkEditorState.h"
#include "dgtkItemDialogs.h"
#include "dgtkMatchDialog.h"
#include "dgtkNamedAction.h"
#include "dgtkPropertiesPanel.h"
#include "dgtkSceneClipboard.h"
#include "dgtkSceneFiles.h"
#include "dgtkSceneTree.h"
#include "dgtkSceneViews.h"
#include "dgtkTimeLine.h"
#include "dgtkTruthPanel.h"
#include "dgtkTruthView.h"
#include "dgtkUniqueNames.h"
#include "dgtkWindowSize.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QMenuBar>
#include <QMessageBox>
#include <QStatusBar>
#include <QToolBar>

namespace dgtk
{

namespace
{
constexpr int narrowestDock = 220; // pixels, of those with fields and lists at the right

/// Above the middle of the scene, aside and before it, as far as the scene is large.
Eigen::Vector3d placeOfLight(const WorldBox& box, UpAxis up)
{
  const Eigen::Vector3d center = box.empty() ? Eigen::Vector3d(0, 0, 0) : box.center();
  const double size = std::max(box.empty() ? 0.0 : box.diagonal(), 1.0);
  const Eigen::Vector3d way = up == UpAxis::Z ? Eigen::Vector3d(0.4, -0.6, 1) : Eigen::Vector3d(0.4, 1, 0.6);
  return (100 * (center + size * way)).array().round() / 100;
}
} // namespace

QAction* MainWindow::addAction(QMenu* menu, const QString& name, const QString& text, const QKeySequence& keys)
{
  // The tool bar has what is used often.
  static const QStringList menuOnly{ "saveAs", "sampleScene", "exportPov", "exportDataset", "selectAll", "rename",
    "properties", "resetLayout" };
  auto* tools = menuOnly.contains(name) ? nullptr : this->findChild<QToolBar*>("toolBar");
  QAction* const action = addNamedAction(this, menu, tools, name, text, keys);
  connect(action, &QAction::triggered, this->State, &EditorState::finishTyping); // before what the action does
  return action;
}

QDockWidget* MainWindow::addDock(const QString& name, const QString& title, QWidget* widget)
{
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName(name);
  dock->setWidget(widget);
  return dock;
}

void MainWindow::makeDocks()
{
  auto* items = new SceneTree(*this->State, this);
  connect(items, &SceneTree::menuAsked, this, &MainWindow::showContextMenu);
  items->setMinimumWidth(narrowestDock);
  this->addDock("treeDock", tr("Scene"), items);
  auto* properties = new PropertiesPanel(*this->State, this);
  properties->setMinimumWidth(narrowestDock);
  this->addDock("propertiesDock", tr("Properties"), properties);
  this->Truth = new TruthView(*this->State, *this->Views, this);
  this->Truth->panel()->setMinimumWidth(narrowestDock);
  QDockWidget* const values = this->addDock("valuesDock", tr("Values"), this->Truth->panel());
  connect(
    this->Truth, &TruthView::pointed, this, [this](const QString& line) { this->statusBar()->showMessage(line); });
  connect(this->Truth, &TruthView::layerChosen, values, [values] { values->raise(); });
  connect(this->Truth, &TruthView::layerChosen, this, &MainWindow::noteReplacedModels);
  connect(this->Views, &SceneViews::lookedThrough, this, &MainWindow::noteReplacedModels);
  this->addDock("timeDock", tr("Time line"), new TimeLine(*this->State, this));
  this->addDock("logDock", tr("Log"), this->Log);
  this->setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  this->arrangeDocks();
}

void MainWindow::arrangeDocks()
{
  const auto place = [this](Qt::DockWidgetArea area, const char* name)
  {
    auto* const dock = this->findChild<QDockWidget*>(name);
    dock->setFloating(false);
    this->addDockWidget(area, dock);
    dock->show();
    return dock;
  };
  QDockWidget* const tree = place(Qt::RightDockWidgetArea, "treeDock");
  QDockWidget* const properties = place(Qt::RightDockWidgetArea, "propertiesDock");
  this->tabifyDockWidget(properties, place(Qt::RightDockWidgetArea, "valuesDock"));
  properties->raise();
  QDockWidget* const time = place(Qt::BottomDockWidgetArea, "timeDock");
  QDockWidget* const log = place(Qt::BottomDockWidgetArea, "logDock");
  this->resizeDocks({ tree, properties }, { 300, 420 }, Qt::Vertical);
  this->resizeDocks({ tree, properties }, { 320, 320 }, Qt::Horizontal);
  this->resizeDocks({ time, log }, { 700, 240 }, Qt::Horizontal);
  this->resizeDocks({ time, log }, { 200, 200 }, Qt::Vertical);
}

void MainWindow::resetLayout()
{
  auto* const tools = this->findChild<QToolBar*>("toolBar");
  this->addToolBar(Qt::TopToolBarArea, tools);
  tools->show();
  this->arrangeDocks();
  this->Views->resetLayout();
}

void MainWindow::makeFileMenu()
{
  QMenu* const menu = this->menuBar()->addMenu(tr("&File"));
  this->Recent = new QMenu(tr("Open &recent"), this);
  this->Recent->setObjectName("recent");
  this->Files = new SceneFiles(*this->State, *this->Views, *this->Log, *this->Work, *this->Recent, *this,
    { [this] { return this->cameraOfView(); },
      [this] { return this->Matching == nullptr || this->Matching->mayDiscard(); } });
  SceneFiles* const files = this->Files;
  connect(this, &MainWindow::closed, files, &SceneFiles::closeSamples);
  connect(files, &SceneFiles::datasetAsked, this, &MainWindow::openDataset);
  const auto add = [&](const char* name, const QString& text, const QKeySequence& keys)
  { return this->addAction(menu, name, text, keys); };
  connect(add("new", tr("&New"), QKeySequence::New), &QAction::triggered, files, &SceneFiles::newScene);
  connect(add("open", tr("&Open ..."), QKeySequence::Open), &QAction::triggered, files, &SceneFiles::askOpen);
  menu->addMenu(this->Recent);
  connect(add("sampleScene", tr("Sampl&e a random scene ..."), {}), &QAction::triggered, files, &SceneFiles::askSample);
  connect(add("save", tr("&Save"), QKeySequence::Save), &QAction::triggered, files, &SceneFiles::save);
  connect(
    add("saveAs", tr("Save &as ..."), QKeySequence("Ctrl+Shift+S")), &QAction::triggered, files, &SceneFiles::saveAs);
  connect(add("openDataset", tr("Open &dataset ..."), QKeySequence("Ctrl+Shift+O")), &QAction::triggered, this,
    &MainWindow::askDataset);
  menu->addSeparator();
  connect(add("import", tr("&Import ..."), QKeySequence("Ctrl+I")), &QAction::triggered, files, &SceneFiles::askImport);
  connect(add("findModels", tr("Find &missing models ..."), {}), &QAction::triggered, files, &SceneFiles::findMissing);
  connect(add("exportPov", tr("Export &POV-Ray ..."), {}), &QAction::triggered, files, &SceneFiles::exportPov);
  connect(add("exportDataset", tr("Expor&t a dataset ..."), {}), &QAction::triggered, this, &MainWindow::exportDataset);
  menu->addSeparator();
  QAction* const leave = menu->addAction(tr("E&xit"));
  leave->setObjectName("exit");
  leave->setIcon(editorIcon("exit"));
  leave->setShortcut(QKeySequence("Ctrl+Q"));
  connect(leave, &QAction::triggered, this, &MainWindow::close);
}

void MainWindow::makeEditMenu()
{
  this->findChild<QToolBar*>("toolBar")->addSeparator();
  QMenu* const menu = this->menuBar()->addMenu(tr("&Edit"));
  EditorState* const state = this->State;
  const auto add = [&](const char* name, const QString& text, const QKeySequence& keys)
  { return this->addAction(menu, name, text, keys); };
  connect(
    add("undo", tr("&Undo"), QKeySequence::Undo), &QAction::triggered, state, [state] { state->document().undo(); });
  connect(add("redo", tr("&Redo"), QKeySequence("Ctrl+Shift+Z")), &QAction::triggered, state,
    [state] { state->document().redo(); });
  menu->addSeparator();
  connect(add("cut", tr("Cu&t"), QKeySequence::Cut), &QAction::triggered, state, &EditorState::cut);
  connect(add("copy", tr("&Copy"), QKeySequence::Copy), &QAction::triggered, state, &EditorState::copy);
  connect(add("paste", tr("&Paste"), QKeySequence::Paste), &QAction::triggered, this->Copied, &SceneClipboard::paste);
  connect(
    add("duplicate", tr("Dup&licate"), QKeySequence("Ctrl+D")), &QAction::triggered, state, &EditorState::duplicate);
  connect(add("delete", tr("&Delete"), QKeySequence::Delete), &QAction::triggered, this, &MainWindow::remove);
  menu->addSeparator();
  connect(
    add("selectAll", tr("Select &all"), QKeySequence::SelectAll), &QAction::triggered, state, &EditorState::selectAll);
  this->makeItemActions(menu);
}

void MainWindow::makeViewMenu()
{
  this->findChild<QToolBar*>("toolBar")->addSeparator();
  QMenu* const menu = this->ViewMenu = this->menuBar()->addMenu(tr("&View"));
  connect(this->addAction(menu, "frameAll", tr("Frame &all"), QKeySequence("R")), &QAction::triggered, this->Views,
    &SceneViews::frameAll);
  connect(this->addAction(menu, "frameSelected", tr("&Frame selected"), QKeySequence("F")), &QAction::triggered,
    this->Views, &SceneViews::frameSelected);
  connect(this->addAction(menu, "maximize", tr("&Maximise or restore the view"), QKeySequence("F11")),
    &QAction::triggered, this, [this] { this->Views->toggleMaximized(this->Views->active()); });
  menu->addSeparator();
  auto* group = new QActionGroup(this);
  const auto addStyle = [&](const char* name, const QString& text, const char* key, ViewStyle style)
  {
    QAction* const action = group->addAction(this->addAction(menu, name, text, QKeySequence(key)));
    action->setCheckable(true);
    action->setChecked(style == ViewStyle::Textured);
    connect(action, &QAction::triggered, this, [this, style] { this->Views->setStyle(style); });
  };
  addStyle("wireframe", tr("&Wireframe"), "W", ViewStyle::Wireframe);
  addStyle("shaded", tr("&Shaded"), "S", ViewStyle::Shaded);
  addStyle("textured", tr("&Textured"), "T", ViewStyle::Textured);
  menu->addSeparator();
  this->Truth->fillMenu(menu->addMenu(tr("S&how in the perspective")));
  QAction* const lights = this->addAction(menu, "sceneLights", tr("Light of the s&cene"), QKeySequence("L"));
  lights->setCheckable(true);
  lights->setChecked(true);
  lights->setToolTip(
    tr("The scene's lights and background in the views, without shadows; otherwise a light at each view's eye"));
  connect(lights, &QAction::toggled, this->Views, &SceneViews::setSceneLights);
  QAction* const grid = this->addAction(menu, "grid", tr("&Grid and axes"), QKeySequence("G"));
  grid->setCheckable(true);
  grid->setChecked(true);
  connect(grid, &QAction::toggled, this->Views, &SceneViews::showGrid);
  menu->addSeparator();
  for (const QDockWidget* dock : this->findChildren<QDockWidget*>())
  {
    menu->addAction(dock->toggleViewAction());
  }
  connect(
    this->addAction(menu, "resetLayout", tr("R&eset layout"), {}), &QAction::triggered, this, &MainWindow::resetLayout);
}

void MainWindow::makeToolsMenu()
{
  this->findChild<QToolBar*>("toolBar")->addSeparator();
  QMenu* const menu = this->menuBar()->addMenu(tr("&Tools"));
  connect(this->addAction(menu, "camera", tr("Add &camera ..."), QKeySequence("Ctrl+Shift+C")), &QAction::triggered,
    this, &MainWindow::addCamera);
  connect(this->addAction(menu, "cameraArray", tr("Add camera &array ..."), {}), &QAction::triggered, this,
    &MainWindow::addCameraArray);
  connect(this->addAction(menu, "light", tr("Add &light ..."), QKeySequence("Ctrl+Shift+L")), &QAction::triggered, this,
    &MainWindow::addLight);
  connect(this->addAction(menu, "render", tr("&Render configuration ..."), QKeySequence("Ctrl+R")), &QAction::triggered,
    this, &MainWindow::configureRendering);
  connect(this->addAction(menu, "correspondence", tr("C&orrespondence ..."), QKeySequence("Ctrl+M")),
    &QAction::triggered, this, &MainWindow::showCorrespondence);
}

void MainWindow::makeHelpMenu()
{
  QMenu* const menu = this->menuBar()->addMenu(tr("&Help"));
  connect(this->addAction(menu, "mouse", tr("&Mouse and keys"), QKeySequence::HelpContents), &QAction::triggered, this,
    [this]
    {
      QMessageBox::information(this, tr("Mouse and keys"),
        tr("<p>Click: select; with Ctrl: add. Drag what is selected: move it in the view's plane. Drag its handles: "
           "move, rotate or scale it (1, 2, 3), about its middle or its origin (O).<br>"
           "During a drag: X, Y, Z keep to an axis, with Shift to the two others; Ctrl: steps; Esc: as it was.<br>"
           "Left drag: turn the perspective, pan the others. Middle or Shift and left: pan.<br>"
           "Right drag or wheel: zoom. Right click: menu. Double click: one view or all four.</p>"
           "<p>R frame all, F frame selected, W wireframe, S shaded, T textured, L the scene's light, G grid, "
           "F11 maximise.<br>"
           "Ctrl+1 to Ctrl+9: the perspective shows a layer, Ctrl+0: colour.<br>"
           "Arrows turn or pan the view with a frame about it, with Shift they pan; + and - zoom.</p>"
           "<p>Ctrl+Z undo, Ctrl+Shift+Z redo, Del delete, F2 rename, K make a key frame, P preview the camera, "
           "Alt+Return properties.</p>"
           "<p>In the time line: Space plays, Left and Right go through the frames, with Ctrl from key to key. "
           "Alt+Left and Alt+Right move the key (with Shift the scene's, with Ctrl a copy), Shift+K removes it. "
           "[ and ] move the start of a sequence, { and } its end.</p>"));
    });
  connect(this->addAction(menu, "about", tr("&About DGTk"), {}), &QAction::triggered, this,
    [this]
    {
      QMessageBox::about(this, tr("About DGTk"),
        tr("DGTk: images and exact ground truth from described 3D scenes. The editor writes the scene files and runs "
           "the "
           "program dgtk; it adds no second way of doing anything."));
    });
}

CameraDescription MainWindow::cameraOfView() const
{
  const ViewCamera& view = this->Views->view(ViewKind::Perspective)->camera();
  CameraDescription camera;
  std::vector<std::string> names;
  for (const CameraDescription& other : this->State->scene().cameras)
  {
    names.push_back(other.name);
  }
  camera.name = uniqueName(names, "Camera0");
  const auto tidy = [](const Eigen::Vector3d& v)
  { return Eigen::Vector3d(((v * 1000).array().round() / 1000).matrix()); };
  camera.eye = tidy(view.eye());
  camera.lookAt = tidy(view.focus());
  camera.up = view.up();
  camera.fovY = ViewCamera::angle(); // sees what the view shows
  return camera;
}

void MainWindow::addCamera()
{
  CameraDialog dialog(this->cameraOfView(), this);
  placeBeside(dialog, *this->Views->view(ViewKind::Perspective)); // where Preview shows what it sees
  connect(&dialog, &CameraDialog::previewAsked, this, [&] { this->Views->lookThrough(dialog.camera()); });
  dialog.onAdd([this](const CameraDescription& camera)
    { return this->State->attempt([&] { this->State->select({ this->document().addCamera(camera) }); }); });
  dialog.exec();
}

void MainWindow::addCameraArray()
{
  CameraPath path;
  for (const SceneItem& item : this->State->selection())
  {
    path = item.kind == SceneItem::Kind::Camera ? keyFramePath(this->State->scene().cameras[item.index]) : path;
  }
  CameraArrayDialog dialog(this->cameraOfView(), path, this);
  dialog.onAdd(
    [this](const std::vector<CameraDescription>& cameras)
    {
      SceneDescription part;
      part.folder = this->State->scene().folder;
      part.cameras = cameras;
      this->State->select(this->document().paste("Add camera array", part));
    });
  dialog.exec();
}

void MainWindow::addLight()
{
  LightDescription light;
  std::vector<std::string> names;
  for (const LightDescription& other : this->State->scene().lights)
  {
    names.push_back(other.name);
  }
  light.name = uniqueName(names, "Light0");
  light.position = placeOfLight(this->Views->places().box, this->State->scene().upAxis);
  LightDialog dialog(light, this);
  dialog.onAdd([this](const LightDescription& added)
    { return this->State->attempt([&] { this->State->select({ this->document().addLight(added) }); }); });
  dialog.exec();
}

void MainWindow::showCorrespondence()
{
  if (this->Matching == nullptr)
  {
    this->Matching = new MatchDialog(*this->State, this);
    connect(this, &MainWindow::closed, this->Matching, &QWidget::hide);
  }
  this->Matching->show();
  this->Matching->raise();
  this->Matching->activateWindow();
}

} // namespace dgtk
