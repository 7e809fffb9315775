// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCloudView.h"
#include "dgtkDatasetViewer.h"
#include "dgtkFrameRow.h"
#include "dgtkPaneGrid.h"
#include "dgtkReadOut.h"
#include "dgtkUsualFolder.h"
#include "dgtkWindowSize.h"

#include <QAction>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QFontDatabase>
#include <QLabel>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

namespace dgtk
{

namespace
{
constexpr int cloudDelay = 150;        // milliseconds after the last change
constexpr int usualRate = 10;          // frames a second
constexpr int calibrationLetters = 48; // of a line of K
} // namespace

DatasetViewer::DatasetViewer(QWidget* parent)
  : QMainWindow(parent)
  , Loader(new PictureLoader(this))
  , Sync(new PictureSync(this))
{
  this->setObjectName("datasetViewer");
  this->setAcceptDrops(true);
  this->setWindowTitle(tr("Dataset - DGTk"));
  this->Tools = this->addToolBar(tr("Tools"));
  this->Tools->setIconSize({ 20, 20 });
  this->Tools->setMovable(false);
  this->Grid = new PaneGrid(*this->Sync, nullptr);
  this->Split = new QSplitter(Qt::Horizontal);
  this->Split->addWidget(this->Grid);
  this->Split->addWidget(this->makeCloudSide());
  this->Split->setStretchFactor(0, 3);
  this->Split->setStretchFactor(1, 1);
  this->Split->setSizes({ 800, 480 });
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(4, 4, 4, 0);
  layout->addWidget(this->Split, 1);
  this->makeCalibration();
  this->makeFileMenu();
  this->makeViewMenu();
  this->makeFramesMenu();
  this->makeCloudMenu();
  this->makeHelpMenu();
  this->Frames = new FrameRow(
    { this->findChild<QAction*>("previousFrame"), this->Play, this->findChild<QAction*>("nextFrame") }, this->Play,
    [this] { return this->Pending.empty() || *this->Pending.begin() >= pointSlots; }, page);
  this->Numbers = new ReadOut(page);
  layout->addWidget(this->Frames);
  layout->addWidget(this->Numbers);
  this->Pages = new QStackedWidget(this);
  this->Pages->addWidget(this->makeEmptyPage());
  this->Pages->addWidget(page);
  this->setCentralWidget(this->Pages);
  this->connectParts();
  this->enableActions(false);
  resizeWithin(*this, 1280, 900);
  const QSettings settings;
  this->restoreGeometry(settings.value("viewer/geometry").toByteArray());
  this->Split->restoreState(settings.value("viewer/split").toByteArray());
  this->Frames->setRate(settings.value("viewer/rate", usualRate).toInt());
  this->statusBar()->show();
}

DatasetViewer::~DatasetViewer()
{
  this->CalibrationDock->disconnect(this); // it is hidden when it goes, after what its slot reads
}

void DatasetViewer::connectParts()
{
  connect(this->Loader, &PictureLoader::opened, this, &DatasetViewer::showDataset);
  connect(this->Loader, &PictureLoader::refused, this, &DatasetViewer::showRefusal);
  connect(this->Loader, &PictureLoader::ready, this, &DatasetViewer::receive);
  connect(this->Loader, &PictureLoader::cloudReady, this,
    [this](const std::shared_ptr<const PointCloud>& cloud, const QString& error)
    {
      if (this->isLeft())
      {
        return;
      }
      this->CloudPending = false;
      this->Cloud->setCloud(cloud);
      this->CloudText->setText(!error.isEmpty()        ? error
                               : cloud->points.empty() ? tr("Points need a layer depth, distance or position.")
                                                       : tr("%L1 points").arg(cloud->points.size()));
      if (!this->CloudFramed)
      {
        this->CloudFramed = true;
        this->Cloud->frameFrom(this->activePane()->camera().toStdString());
      }
      this->refreshBusy();
    });
  connect(this->Loader, &PictureLoader::overlaysReady, this, &DatasetViewer::receiveOverlays);
  connect(this->Sync, &PictureSync::cursorChanged, this, &DatasetViewer::refreshReadOut);
  connect(this->Frames, &FrameRow::changed, this, &DatasetViewer::askAll);
  connect(this->Frames, &FrameRow::advanced, this, &DatasetViewer::prefetch);
  connect(this->Grid, &PaneGrid::dropped, this->Loader, &PictureLoader::drop);
  connect(this->Grid, &PaneGrid::arranged, this, &DatasetViewer::refreshReadOut);
  connect(this->Grid, &PaneGrid::activated, this,
    [this]
    {
      this->refreshCloudCameras();
      this->refreshCalibration();
      this->CloudTimer.start();
    });
  connect(this->Grid, &PaneGrid::chosen, this, &DatasetViewer::askChosen);
  connect(this->Grid, &PaneGrid::rangeAsked, this, &DatasetViewer::setRange);
  connect(this->Grid, &PaneGrid::detailWanted, this,
    [this](const PicturePane* pane, const PixelRect& window, int step)
    {
      PictureAsk ask = this->askOf(*pane, this->frame());
      ask.window = window;
      ask.step = step;
      this->Loader->ask(detailSlots + pane->number(), ask);
    });
  connect(this->Cloud, &CloudView::cameraPicked, this,
    [this](const QString& name)
    {
      PicturePane* const pane = this->activePane();
      pane->choose(name, pane->layer());
      this->askChosen(pane);
    });
  this->CloudTimer.setSingleShot(true);
  this->CloudTimer.setInterval(cloudDelay);
  connect(&this->CloudTimer, &QTimer::timeout, this, &DatasetViewer::askCloud);
}

void DatasetViewer::refreshBusy()
{
  this->setProperty("busy", !this->Pending.empty() || this->CloudPending || this->CloudTimer.isActive());
}

void DatasetViewer::askCloud()
{
  const PicturePane* const pane = this->activePane();
  if (!this->Dataset || pane == nullptr || !this->ShowCloud->isChecked())
  {
    this->refreshBusy();
    return;
  }
  CloudAsk ask;
  ask.cameras =
    this->AllCameras->isChecked() ? this->Dataset->cameras() : std::vector<std::string>{ pane->camera().toStdString() };
  ask.frame = this->frame();
  ask.colorLayer = this->ColorByPane->isChecked() ? pane->layer().toStdString() : std::string();
  this->CloudPending = true;
  this->refreshBusy();
  this->Loader->askCloud(ask);
}

QWidget* DatasetViewer::makeCloudSide()
{
  this->CloudSide = new QWidget;
  auto* layout = new QVBoxLayout(this->CloudSide);
  layout->setContentsMargins(2, 2, 2, 2);
  layout->setSpacing(2);
  this->Cloud = new CloudView(this->CloudSide);
  this->CloudText = new QLabel(this->CloudSide);
  this->CloudText->setTextFormat(Qt::PlainText);
  this->CloudText->setObjectName("cloudText");
  this->CloudText->setWordWrap(true);
  layout->addWidget(this->Cloud, 1);
  layout->addWidget(this->CloudText);
  return this->CloudSide;
}

void DatasetViewer::makeCalibration()
{
  this->CalibrationDock = new QDockWidget(tr("Calibration"), this);
  this->CalibrationDock->setObjectName("calibrationDock");
  this->Calibration = new QPlainTextEdit(this->CalibrationDock);
  this->Calibration->setObjectName("calibration");
  this->Calibration->setAccessibleName(tr("Calibration"));
  this->Calibration->setReadOnly(true);
  this->Calibration->setLineWrapMode(QPlainTextEdit::NoWrap);
  this->Calibration->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  this->Calibration->setMinimumWidth(
    this->Calibration->fontMetrics().horizontalAdvance(QString(calibrationLetters, '0')));
  this->CalibrationDock->setWidget(this->Calibration);
  this->addDockWidget(Qt::RightDockWidgetArea, this->CalibrationDock);
  this->CalibrationDock->hide();
  connect(this->CalibrationDock, &QDockWidget::visibilityChanged, this, &DatasetViewer::refreshCalibration);
}

QWidget* DatasetViewer::makeEmptyPage()
{
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  this->EmptyText =
    new QLabel(tr("No dataset is open. Open the folder that <i>dgtk render</i> wrote, or drop it here."));
  this->EmptyText->setObjectName("emptyText");
  this->EmptyText->setAlignment(Qt::AlignCenter);
  this->EmptyText->setWordWrap(true);
  auto* open = new QPushButton(tr("Open dataset ..."));
  open->setObjectName("openFirst");
  connect(open, &QPushButton::clicked, this, &DatasetViewer::askOpen);
  layout->addStretch();
  layout->addWidget(this->EmptyText);
  layout->addWidget(open, 0, Qt::AlignCenter);
  layout->addStretch();
  return page;
}

void DatasetViewer::closeEvent(QCloseEvent* event)
{
  QSettings settings;
  settings.setValue("viewer/geometry", this->saveGeometry());
  settings.setValue("viewer/split", this->Split->saveState());
  settings.setValue("viewer/rate", this->Frames->rate());
  event->accept();
  emit this->left();
}

void DatasetViewer::dragEnterEvent(QDragEnterEvent* event)
{
  if (!localFiles(*event->mimeData()).isEmpty())
  {
    event->acceptProposedAction();
  }
}

void DatasetViewer::dropEvent(QDropEvent* event)
{
  const QStringList paths = localFiles(*event->mimeData());
  if (!paths.isEmpty())
  {
    event->acceptProposedAction();
    this->openFolder(paths.front());
  }
}

} // namespace dgtk
