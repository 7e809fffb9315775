// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorTruth_h
#define TestEditorTruth_h

#include "EditorTest.h"

#include <QPoint>
#include <QPointF>

class QWidget;

/// Ground truth in the perspective view, and the correspondence tool.
class TestEditorTruth : public EditorTest
{
  Q_OBJECT

protected:
  /// Some look at squares of many pixels, or between objects.
  QSize windowSize(const QString& testCase) const override
  {
    const bool isLarge = testCase == "viewsHaveTheRenderersColours" || testCase == "clicksGoThroughThePicture";
    return isLarge ? QSize(1280, 860) : EditorTest::windowSize(testCase);
  }

private slots:
  void layersReplaceColourAndFollowTheView();
  void valuesAreTheDatasets();
  void previewLeavesTheViewFree();
  void previewIsTheCamerasPicture();
  void viewsHaveTheRenderersColours_data();
  void viewsHaveTheRenderersColours();
  void texturesAreSmoothFromAfar();
  void whatIsNotTheRenderersSaysDraft();
  void clicksGoThroughThePicture();
  void nothingWaitsForPictures();
  void theSceneMayChangeMeanwhile();
  void matchesAreTheDatasets();
  void pairsAreThoseOfTheCommandLine();
  void selectedCamerasAreMatched();
  void pairsAreUndone();
  void pairsOfAChangedSceneAreMarked();
  void manyPairsOpenAtOnce();
  void panesZoomAndPan();
  void aStereoPairWithGroundTruth();
  void germanIsSpokenOfTheTruth();
  void pictures();

private:
  void render(const QString& layers, const QStringList& more) const;
  /// The dialog, its pictures shown.
  QWidget* openMatches() const;
  /// Clicks an image point and waits for its match.
  void clickMatch(QWidget* dialog, int side, const QPointF& image) const;
};

#endif
