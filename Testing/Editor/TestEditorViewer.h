// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorViewer_h
#define TestEditorViewer_h

#include "EditorTest.h"

#include <QCoreApplication>
#include <QWidget>

class QMainWindow;

namespace dgtk
{
class DatasetViewer;
}

/// The pixel that the viewer says is under the crosshair; (-1, -1) for none.
QPoint pixelOf(const QMainWindow* viewer);

/// The window of finished datasets.
class TestEditorViewer : public EditorTest
{
  Q_OBJECT

public:
  TestEditorViewer();
  ~TestEditorViewer() override;

protected slots:
  void cleanup();

protected:
  QSize windowSize(const QString& /*testCase*/) const override { return { 860, 620 }; }
  /// The viewer needs no editor.
  bool hasWindow(const QString& testCase) const override;

private slots:
  void opensByFolderManifestAndDrop();
  void framesStepAndPlay();
  void numbersAreThoseOfTheFiles();
  void zoomIsCommon();
  void presetsAndLayouts();
  void rangesAreChosen();
  void keysReachEverything();
  void camerasAndPointsInTheWorld();
  void theMouseMovesTheWorld();
  void layeredImagesHaveSurfaces();
  void brokenDatasetsAreRefused();
  void aReplacedDatasetIsOpenedAgain();
  void theRenderDialogOpensItsResult();
  void germanIsSpokenOfPixels();
  void longNamesAreLegible();
  void boxesAndPointsLieOverPictures();
  void masksHaveASliceForEachObject();
  void calibrationIsShown();
  void noEventTakesLong();
  void largePicturesAreReadInDetail();
  void scrolledPicturesKeepTheirShape();
  void theViewerOpensWhereItWas();
  void theProgramEndsWithItsDatasets();
  void objectNumbersAreThoseOfTheDataset();
  void germanIsSpokenOfCameras();
  void randomEventsDoNoHarm();
  void pictures();

private:
  /// Some of the demo's objects, of which one turns.
  QString scene() const;
  /// A small dataset of it, rendered once.
  QString dataset();
  /// Another one, with what is no picture: boxes, masks, points, calibration.
  QString richDataset();
  /// Opens it in a window of its own, by the editor where there is one, and waits for its pictures.
  QMainWindow* open(const QString& folder);
  /// The window that is open, with its pictures; null for none.
  QMainWindow* viewer() const;
  void waitForPictures(QMainWindow* viewer) const;
  QString cell(QMainWindow* viewer, int row, int column) const;
  /// The widget of a pane's picture.
  QWidget* picture(QMainWindow* viewer, int pane) const;
  void choose(QMainWindow* viewer, int pane, const QString& camera, const QString& layer) const;
  /// Brings the crosshair to a pixel by keys.
  void pointAt(QMainWindow* viewer, int x, int y) const;

  std::unique_ptr<dgtk::DatasetViewer> Alone;
  QString Rendered;
  QString RenderedRich;
};

#endif
