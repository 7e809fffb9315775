// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditor_h
#define TestEditor_h

#include "EditorTest.h"

/// The window as it is used from day to day.
class TestEditor : public EditorTest
{
  Q_OBJECT

private slots:
  void opensSelectsMovesUndoesSavesAndRenders();
  void clicksSelectAndDragsMove();
  void keyFramesPlay();
  void copiesCutsAndPastes();
  void pastesWhatOtherWindowsCopied();
  void aFamilyIsCutAndPasted();
  void addsCamerasAndLights();
  void refusesWithAMessage();
  void asksAboutUnsavedWork();
  void theViewsLookAsTheyWereLeft();
  void unsavedWorkSurvivesACrash();
  void aDamagedCopyIsToldOfItsScene();
  void whatWasKeptIsDiscardedOrAskedAgain();
};

#endif
