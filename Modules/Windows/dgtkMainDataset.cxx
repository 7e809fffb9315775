// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetViewer.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneFiles.h"
#include "dgtkUsualFolder.h"

#include <QDir>
#include <QFileDialog>

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
  viewer->show();
  viewer->openFolder(folder);
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
