// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCloudView.h"
#include "dgtkDatasetViewer.h"
#include "dgtkFrameRow.h"
#include "dgtkNamedAction.h"
#include "dgtkPaneGrid.h"
#include "dgtkReadOut.h"
#include "dgtkSaveName.h"
#include "dgtkUsualFolder.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>

namespace dgtk
{

namespace
{
constexpr double zoomStep = 1.25;
} // namespace

QAction* DatasetViewer::addAction(
  QMenu* menu, const QString& name, const QString& text, const QKeySequence& keys, bool tool)
{
  return addNamedAction(this, menu, tool ? this->Tools : nullptr, name, text, keys);
}

void DatasetViewer::makeFileMenu()
{
  QMenu* const menu = this->menuBar()->addMenu(tr("&File"));
  connect(this->addAction(menu, "open", tr("&Open dataset ..."), QKeySequence::Open), &QAction::triggered, this,
    &DatasetViewer::askOpen);
  connect(this->addAction(menu, "save", tr("&Save the picture ..."), QKeySequence::Save), &QAction::triggered, this,
    &DatasetViewer::savePicture);
  connect(this->addAction(menu, "copyValues", tr("&Copy the numbers"), QKeySequence("Ctrl+Shift+C")),
    &QAction::triggered, this, &DatasetViewer::copyValues);
  menu->addSeparator();
  connect(this->addAction(menu, "close", tr("C&lose"), QKeySequence("Ctrl+W")), &QAction::triggered, this,
    &DatasetViewer::close);
  connect(this->addAction(menu, "exit", tr("E&xit"), QKeySequence("Ctrl+Q"), false), &QAction::triggered, this,
    &DatasetViewer::exitAsked);
  this->Tools->addSeparator();
}

void DatasetViewer::makeViewMenu()
{
  QMenu* const menu = this->menuBar()->addMenu(tr("&View"));
  const auto add = [&](const char* name, const QString& text, const char* keys, const std::function<void()>& act)
  { connect(this->addAction(menu, name, text, QKeySequence(keys)), &QAction::triggered, this, act); };
  add("fit", tr("&Fit"), "F", [this] { this->Grid->fit(); });
  add("actualSize", tr("&One to one"), "1", [this] { this->Grid->actualSize(); });
  add("zoomIn", tr("Zoom &in"), "+", [this] { this->Grid->zoom(zoomStep); });
  add("zoomOut", tr("Zoom o&ut"), "-", [this] { this->Grid->zoom(1 / zoomStep); });
  this->findChild<QAction*>("zoomIn")->setShortcuts({ QKeySequence("+"), QKeySequence("="), QKeySequence::ZoomIn });
  this->findChild<QAction*>("zoomOut")->setShortcuts({ QKeySequence("-"), QKeySequence::ZoomOut });
  menu->addSeparator();
  const std::pair<int, QString> layouts[] = { { 1, tr("One &picture") }, { 2, tr("&Two pictures") },
    { 4, tr("Fou&r pictures") } };
  for (const auto& [number, words] : layouts)
  {
    const int count = number;
    add(qPrintable(QString("panes%1").arg(count)), words, qPrintable(QString("Ctrl+%1").arg(count)),
      [this, count]
      {
        this->setPaneCount(count);
        this->askAll();
      });
  }
  add("layersOfCamera", tr("All &layers of one camera"), "L", [this] { this->layersOfOneCamera(); });
  add("camerasOfLayer", tr("One layer of all &cameras"), "C", [this] { this->oneLayerOfCameras(); });
  add("maximize", tr("&Maximise or restore the picture"), "F11",
    [this] { this->Grid->maximize(this->activePane() ? this->activePane()->number() : 0); });
  menu->addSeparator();
  const auto addCheck = [&](const char* name, const QString& text, const char* keys)
  {
    QAction* const action = this->addAction(menu, name, text, QKeySequence(keys), false);
    action->setCheckable(true);
    connect(action, &QAction::toggled, this, &DatasetViewer::askOverlays);
    return action;
  };
  this->ShowBoxes = addCheck("boxes", tr("&Boxes of objects"), "B");
  this->ShowPoints = addCheck("sparsePoints", tr("&Sparse points"), "S");
  QAction* const calibration = this->CalibrationDock->toggleViewAction();
  calibration->setObjectName("calibration");
  calibration->setText(tr("C&alibration of the camera"));
  calibration->setShortcut(QKeySequence("K"));
  menu->addAction(calibration);
  this->Tools->addSeparator();
}

void DatasetViewer::makeFramesMenu()
{
  QMenu* const menu = this->menuBar()->addMenu(tr("F&rames"));
  this->Play = this->addAction(menu, "play", tr("&Play"), QKeySequence("P"), false);
  this->Play->setCheckable(true);
  const auto add = [&](const char* name, const QString& text, const char* keys, const std::function<void()>& act)
  { connect(this->addAction(menu, name, text, QKeySequence(keys), false), &QAction::triggered, this, act); };
  add("nextFrame", tr("&Next"), ".", [this] { this->Frames->step(1); });
  add("previousFrame", tr("Pre&vious"), ",", [this] { this->Frames->step(-1); });
  add("firstFrame", tr("&First"), "Home", [this] { this->Frames->setIndex(0); });
  add("lastFrame", tr("&Last"), "End", [this] { this->Frames->setIndex(this->Frames->last()); });
}

void DatasetViewer::makeCloudMenu()
{
  QMenu* const menu = this->menuBar()->addMenu(tr("&3D view"));
  this->ShowCloud = this->addAction(menu, "cloud", tr("&Show the 3D view"), QKeySequence("V"));
  this->ShowCloud->setCheckable(true);
  this->ShowCloud->setChecked(true);
  connect(this->ShowCloud, &QAction::toggled, this,
    [this](bool on)
    {
      this->CloudSide->setVisible(on);
      this->askCloud();
    });
  this->AllCameras = this->addAction(menu, "allCameras", tr("Points of &all cameras"), QKeySequence("A"));
  this->AllCameras->setCheckable(true);
  connect(this->AllCameras, &QAction::toggled, this, [this] { this->askCloud(); });
  this->ColorByPane =
    this->addAction(menu, "colorByPane", tr("Colours of the &chosen picture"), QKeySequence("Shift+C"));
  this->ColorByPane->setCheckable(true);
  connect(this->ColorByPane, &QAction::toggled, this, [this] { this->askCloud(); });
  menu->addSeparator();
  connect(this->addAction(menu, "frameCloud", tr("Show &everything"), QKeySequence("R")), &QAction::triggered, this,
    [this] { this->Cloud->frameAll(); });
  connect(this->addAction(menu, "lookThrough", tr("&Look from the camera"), QKeySequence("T")), &QAction::triggered,
    this, [this] { this->Cloud->lookThrough(this->activePane()->camera().toStdString()); });
}

void DatasetViewer::enableActions(bool on)
{
  for (QAction* menu : this->menuBar()->actions())
  {
    for (QAction* action : menu->menu()->actions())
    {
      const QString name = action->objectName();
      action->setEnabled(on || name == "open" || name == "close" || name == "mouse");
    }
  }
  this->ShowBoxes->setEnabled(on && this->Dataset->hasDocuments(DatasetDocument::Boxes));
  this->ShowPoints->setEnabled(on && this->Dataset->hasDocuments(DatasetDocument::Points));
}

void DatasetViewer::makeHelpMenu()
{
  QMenu* const menu = this->menuBar()->addMenu(tr("&Help"));
  connect(this->addAction(menu, "mouse", tr("&Mouse and keys"), QKeySequence::HelpContents), &QAction::triggered, this,
    [this]
    {
      QMessageBox::information(this, tr("Mouse and keys"),
        tr(
          "<p>Pictures. Wheel: zoom at the mouse, in all pictures. Drag: pan. Double click: this picture alone, or all "
          "again.<br>Arrow keys: the crosshair by a pixel, with Shift by ten; with Ctrl they pan.<br>"
          "F fit, 1 one to one, + and - zoom at the crosshair.</p>"
          "<p>Frames. Comma and full stop: one back, one on; Home, End; P play.</p>"
          "<p>3D view. Left drag or arrow keys: turn. Middle or Shift and left drag, Shift and arrow keys: pan. Right "
          "drag or wheel: zoom. Click a camera: its pictures in the chosen pane.</p>"));
    });
}

void DatasetViewer::askOpen()
{
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Open a dataset"), usualFolder("dataset"));
  if (!folder.isEmpty())
  {
    this->openFolder(folder);
  }
}

void DatasetViewer::savePicture()
{
  const PicturePane* const pane = this->activePane();
  const ShownPointer shown = pane ? pane->view().shown() : nullptr;
  if (!shown || !shown->picture)
  {
    return;
  }
  const QString path = askSaveName(this, tr("Save the picture"), {}, tr("PNG (*.png)"));
  const QImage image(reinterpret_cast<const uchar*>(shown->colors.pixels.data()), shown->picture->columns(),
    shown->picture->rows(), shown->picture->columns() * 4, QImage::Format_RGB32);
  if (!path.isEmpty() && !image.save(path, "PNG"))
  {
    QMessageBox box(QMessageBox::Warning, tr("DGTk"), tr("%1 cannot be written.").arg(path), QMessageBox::Ok, this);
    box.setTextFormat(Qt::PlainText);
    box.exec();
  }
}

void DatasetViewer::copyValues() { QApplication::clipboard()->setText(this->Numbers->text()); }

} // namespace dgtk
