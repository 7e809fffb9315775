// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorTyping_h
#define TestEditorTyping_h

#include "EditorTest.h"

/// What is typed into the window and its dialogs.
class TestEditorTyping : public EditorTest
{
  Q_OBJECT

private slots:
  void whatIsBeingTypedIsSaved();
  void whatIsBeingTypedIsKept();
  void quaternionsAreTypedAsOne();
  void aRefusalComesOnce();
  void dialogsKeepWhatIsRefused();
  void hugeSizesAreRefused();
  void numbersThatAreNoneAreTold();
  void noKeyIsDropped();
  void wordsAroundANumberStay();
  void unitsAreTyped();
  void everyNumberIsOfItsOwnProperty();
  void parametersOfAModelAreTyped();
  void allLayersAreRendered();
  void rowsEndQuietly();
};

#endif
