// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBackgroundWork.h"
#include "dgtkDatasetViewer.h"
#include "dgtkEditorState.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneFiles.h"
#include "dgtkUsualFolder.h"

#include <QApplication>
#include <QDir>
#include <QFileDialog>

#include <algorithm>

namespace dgtk
{

void MainWindow::openDataset(const QString& folder)
{
  auto* viewer = new DatasetViewer; // beside this window, not above it
  viewer->setAttribute(Qt::WA_DeleteOnClose);
  connect(this, &QObject::destroyed, viewer, [viewer] { delete viewer; });
  connect(this, &MainWindow::closed, viewer, &QWidget::close);
  connect(viewer, &DatasetViewer::opened, this,
    [this](const QString& shown) // which may be another one, that was opened there
    {
      this->Files->addRecent(QDir::cleanPath(shown));
      rememberFolder(shown, "dataset");
    });
  connect(viewer, &DatasetViewer::left, this, &MainWindow::closeAfterDatasets, Qt::QueuedConnection);
  connect(viewer, &DatasetViewer::exitAsked, this, &QWidget::close, Qt::QueuedConnection);
  viewer->show();
  viewer->openFolder(folder);
}

void MainWindow::closeAfterDatasets()
{
  const QWidgetList windows = QApplication::topLevelWidgets();
  const bool isAlone = std::none_of(
    windows.begin(), windows.end(), [this](const QWidget* window) { return window != this && window->isVisible(); });
  const SceneDocument& document = this->State->document();
  if (this->IsForDatasets && this->isVisible() && !this->Work->busy() && isAlone && !document.modified() &&
      document.path().empty() && document.scene().items().empty())
  {
    this->close();
  }
}

void MainWindow::askDataset()
{
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Open a dataset"), usualFolder("dataset"));
  if (!folder.isEmpty())
  {
    this->openDataset(folder);
  }
}

} // namespace dgtk
