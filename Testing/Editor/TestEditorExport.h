// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorExport_h
#define TestEditorExport_h

#include "EditorTest.h"

#include <QStringList>

class QDialog;

class TestEditorExport : public EditorTest
{
  Q_OBJECT

protected:
  QSize windowSize(const QString& /*testCase*/) const override { return { 860, 620 }; }

private slots:
  void anExportHasTheBytesOfTheCommandLine();
  void refusalsAreInTheWindowsWords();
  void aRenderForAnExportHasItsLayers();
  void foldersAreBrowsed();
  void pictures();

private:
  /// A dataset for COCO, made by the command line.
  QString dataset() const;
  QDialog* dialog(const QString& folder) const;
  /// Clicks Start and waits; what the dialog says then.
  static QString started(const QDialog& shown);
};

#endif
