// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorSamples_h
#define TestEditorSamples_h

#include "EditorTest.h"

#include <QByteArray>

class QDialog;
class QString;

/// Samples of random scenes drawn into the window.
class TestEditorSamples : public EditorTest
{
  Q_OBJECT

protected:
  QSize windowSize(const QString& /*testCase*/) const override { return { 860, 620 }; }

private slots:
  void samplesAreThoseOfTheCommandLine();
  void theKeyboardChoosesSamples();
  void aTypedNumberEndsWithTheWindow();
  void whatIsRefusedAndLeftOutIsSaid();
  void aSampleIsStopped();
  void unsavedWorkIsAskedAbout();
  void whatIsGivenUpIsGivenUpForOneSample();
  void aSampleIsKept();
  void manyAreWritten();
  void writingIsCancelled();
  void pictures();

private:
  /// A random scene in a file of that name.
  QString write(const char* name, const QByteArray& scene) const;
  /// Opens a random scene as any other, and takes what is offered.
  QDialog* opened(const QString& scene) const;
  QString status(const char* name = "status") const;
  /// Until nothing is drawn; what the dialog says then begins so.
  void waitFor(const QString& beginning) const;
  void click(const char* button) const;
  /// The scene in the window, as the file beside the random scene would be.
  QByteArray shown() const;
  /// A sample as `dgtk sample` writes it into a folder of that name.
  QByteArray sampled(const QString& scene, int number, const QString& folder) const;
};

#endif
