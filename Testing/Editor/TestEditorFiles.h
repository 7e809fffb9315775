// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorFiles_h
#define TestEditorFiles_h

#include "EditorTest.h"

#include <functional>

class QDialog;
class QFileDialog;
class QPushButton;
class QString;
class QTimer;

class TestEditorFiles : public EditorTest
{
  Q_OBJECT

protected:
  bool hasWindow(const QString& testCase) const override { return testCase != "filesOfTheCommandLineOpen"; }

private slots:
  void samplesAreImportedOrRefused();
  void damagedFilesAreRefused();
  void filesThatEndEarlyAreRefused();
  void anImporterThatCrashesIsAMessage();
  void filesAreDropped();
  void theImportDialogKnowsAllFormats();
  void savingAsksAboutTheFileThatItWrites();
  void savingAsksAboutWhatItDestroys();
  void everyFileIsAskedAbout();
  void exportsForPovRay();
  void filesOfTheCommandLineOpen();
  void recentFilesOpenAgain();
  void recentFilesThatAreGoneAreForgotten();
  void whatCannotBeWrittenGoesElsewhere();
  void anyNameIsShownAsItIs();
  void theLogsCommandIsForAShell();
  void theWindowIsAsItWasLeft();
  void readingDoesNotHoldTheWindow();
  void readingIsCancelled();
  void warningsAreNotedOnce();
  void missingModelsAreBoxes();
  void missingModelsAreFound();
  void aCancelledExportWritesNothing();
  void theWindowClosesWhileItReads();
  void theProgressOfARunMoves();
  void aLargeRunEndsAtOnce();
  void aRunEndsThatHasJustBegun();
  void pictures();

private:
  static QString model(const char* name);
  static QByteArray contentsOf(const QString& path);
  /// As soon as Cancel of the work in the background is there; stops the timer.
  void whenReading(QTimer& timer, const std::function<void(QPushButton&)>& act) const;
  QString write(const char* name, const QByteArray& contents) const;
  /// Imports a file; returns what the dialog said, "" when there was none.
  QString import(const QString& path);
  /// As import(), and the scene is as before when there was a dialog, and has one object more when there was none.
  QString importChecked(const QString& path);
  /// As if a name were typed into a dialog for files and confirmed; `filter` is chosen before.
  static void name(QFileDialog& dialog, const QString& path, const QString& filter = {});
  /// Triggers an action that opens a file dialog.
  void inFileDialog(const char* action, const std::function<void(QFileDialog&)>& act) const;
  /// The dialog of a run of square pictures of all cameras.
  QDialog* largeRun(const char* folder, int size) const;
  /// An importer that runs a line of shell.
  void useImporter(const QByteArray& line) const;
  /// One that runs the line after letImporterGo().
  void useWaitingImporter(const QByteArray& line = {}) const;
  /// Ends the waiting, and the use of the importer.
  void letImporterGo() const;
  /// A scene whose two models are not there; its path.
  QString sceneWithoutModels() const;
};

#endif
