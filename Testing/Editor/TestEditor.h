// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditor_h
#define TestEditor_h

#include "EditorTest.h"

#include <QAction>
#include <QList>
#include <QPointer>

class TestEditor : public EditorTest
{
  Q_OBJECT

private slots:
  void opensSelectsMovesUndoesSavesAndRenders();
  void clicksSelectAndDragsMove();
  void keyFramesPlay();
  void copiesCutsAndPastes();
  void aFamilyIsCutAndPasted();
  void addsCamerasAndLights();
  void refusesWithAMessage();
  void asksAboutUnsavedWork();
  void whatIsBeingTypedIsSaved();
  void whatIsBeingTypedIsKept();
  void quaternionsAreTypedAsOne();
  void aRefusalComesOnce();
  void dialogsKeepWhatIsRefused();
  void hugeSizesAreRefused();
  void unitsAreTyped();
  void rowsEndQuietly();
  void allLayersAreRendered();
  void closingEndsTheProgram();
  void aClosedViewerEndsNothing();
  void unsavedWorkSurvivesACrash();
  void parallelViewsCutNothing();
  void viewsMoveByKeys();
  void stylesLookDifferent();
  void theViewsLookAsTheyWereLeft();
  void savingIsAnAnswer();
  void lightsHaveAllTheirNumbers();
  void camerasHaveSizesOfTheirOwn();
  void cancelledRunsResume();
  void everyMenuItemWorks();
  void theWindowAnswersWhileItRenders();
  void pictures();

private:
  QList<QPointer<QAction>> menuItems() const;
  void prepareFor(const QAction& item) const;
};

#endif
