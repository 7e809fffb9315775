// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorWhole_h
#define TestEditorWhole_h

#include "EditorTest.h"

/// The window, its views, runs and other windows together.
class TestEditorWhole : public EditorTest
{
  Q_OBJECT

private slots:
  void camerasHaveSizesOfTheirOwn();
  void cancelledRunsResume();
  void closingEndsTheProgram();
  void aClosedViewerEndsNothing();
  void parallelViewsCutNothing();
  void viewsMoveByKeys();
  void aPreviewHasTheCamerasPose();
  void stylesLookDifferent();
  void savingIsAnAnswer();
  void lightsHaveAllTheirNumbers();
  void pictures();
};

#endif
