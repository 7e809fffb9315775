// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorLook_h
#define TestEditorLook_h

#include "EditorTest.h"

/// How the window looks on dense displays (run with QT_SCALE_FACTOR=2, too) and in other languages.
class TestEditorLook : public EditorTest
{
  Q_OBJECT

protected:
  bool hasWindow(const QString& testCase) const override
  {
    return testCase != "germanIsShownEverywhere" && testCase != "languagesAreNamed";
  }

private slots:
  void viewsHaveAllPixelsOfTheDisplay();
  void aViewIsDrawnOnceForASize();
  void clicksMeetWhatIsSeen();
  void camerasAndLightsAreFramedAsTheyAreDrawn();
  void theUpAxisTurnsTheViews();
  void smallModelsKeepTheirTexturesSeams();
  void germanIsShownEverywhere();
  void languagesAreNamed();
  void pictures();

private:
  QImage picture(const char* view) const;
};

#endif
