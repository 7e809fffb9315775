// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleWriter_h
#define dgtkSampleWriter_h

#include "dgtkRenderProcess.h"

#include <QGroupBox>

#include <cstdint>
#include <optional>

class QCheckBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace dgtk
{

/// Samples A to B of a random scene into a folder: what `dgtk sample` does, with its progress. It outlives the window.
class SampleWriter : public QGroupBox
{
  Q_OBJECT

public:
  explicit SampleWriter(QWidget* parent);

  /// The random scene, unless samples of another are being written; the folder follows it.
  void setScene(const QString& path);
  /// None: the scene's own.
  void setSeed(std::optional<std::uint64_t> seed) { this->Seed = seed; }

signals:
  void noted(const QString& line);

private:
  void makeFields(QVBoxLayout* layout);
  void makeButtons(QVBoxLayout* layout);
  void browse();
  void start();
  void finish(RunLog::End end, QString message);
  void setRunning(bool on);

  RenderProcess Process;
  QString Scene;
  QString Named; ///< the folder's name as it follows from the scene
  std::optional<std::uint64_t> Seed;
  QSpinBox* First = nullptr;
  QSpinBox* Last = nullptr;
  QLineEdit* Folder = nullptr;
  QCheckBox* Replace = nullptr;
  QProgressBar* Progress = nullptr;
  QLabel* Status = nullptr;
  QPushButton* Write = nullptr;
  QPushButton* Cancel = nullptr;
};

} // namespace dgtk

#endif
