// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorRuns_h
#define TestEditorRuns_h

#include "EditorTest.h"

#include <QByteArray>
#include <QMap>
#include <QString>

class QDialog;
class QProcess;

class TestEditorRuns : public EditorTest
{
  Q_OBJECT

protected:
  bool hasWindow(const QString& testCase) const override { return testCase != "aRunOutlivesItsEditor"; }

private slots:
  void quittingAsks();
  void theQuestionGoesWithTheRun();
  void aRunOutlivesItsEditor_data();
  void aRunOutlivesItsEditor();
  void aKilledRunGoesOn_data();
  void aKilledRunGoesOn();
  void anEndIsToldAtTheNextStart();
  void unfinishedRunsAreNotReplacedUnasked();
  void aChangedSceneIsAskedAbout();
  void theStatusBarShowsTheRun();
  void aRefusalIsShownOnce();

private:
  /// A scene, opened if wanted, and no folder "out" yet.
  void prepare(bool open = true);
  /// The render configuration.
  QDialog* dialog() const;
  /// Starts in the dialog, and stops the process when its first file is there.
  void startHeld() const;
  /// An editor of its own that renders, whose run is held likewise.
  void startEditor(QProcess& editor) const;
  void holdNext() const;
  void waitUntilHeld() const;
  static void sendAll(int signal); ///< to all runs
  /// Lets the process of startHeld() go on.
  static void letGo();
  /// As after a start of the editor.
  void openWindow();
  /// The run in the dialog comes to its end, and its files are those of the command line.
  void finishes() const;
  QMap<QString, QByteArray> expected() const;

  mutable QMap<QString, QByteArray> Expected;
  QString Scene;
};

#endif
