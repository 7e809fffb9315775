// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportDialog_h
#define dgtkExportDialog_h

#include "dgtkRenderProcess.h"
#include "dgtkRunsModule.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace dgtk
{

class ExportOptions;

/// A finished dataset in the format of other people's tools: what `dgtk export` does, with its progress. The export
/// outlives the window.
class DGTKRUNS_EXPORT ExportDialog : public QDialog
{
  Q_OBJECT

public:
  explicit ExportDialog(QWidget* parent);

  /// The dataset to begin with; the folder of the export follows it.
  void offer(const QString& dataset);
  /// The words after `dgtk`.
  QStringList arguments() const;
  bool running() const { return this->Process.running(); }

signals:
  void noted(const QString& line);

private:
  void makeFields(QVBoxLayout* layout);
  void makeButtons(QVBoxLayout* layout);
  void chooseFormat();
  void nameFolder();
  void start();
  void finish(RunLog::End end, const QString& message);
  void setRunning(bool on);

  RenderProcess Process;
  QLineEdit* Dataset = nullptr;
  QComboBox* Format = nullptr;
  QLabel* Description = nullptr;
  QLineEdit* Folder = nullptr;
  QString Named; ///< the folder's name as it follows from the others
  ExportOptions* Options = nullptr;
  QCheckBox* Replace = nullptr;
  QProgressBar* Progress = nullptr;
  QLabel* Status = nullptr;
  QPushButton* Start = nullptr;
  QPushButton* Cancel = nullptr;
};

} // namespace dgtk

#endif
