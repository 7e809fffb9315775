// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleDialog_h
#define dgtkSampleDialog_h

#include "dgtkRunsModule.h"

#include "dgtkSampleDrawer.h"

#include <QDialog>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

class QDoubleSpinBox;
class QLabel;
class QPlainTextEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTreeWidget;
class QVBoxLayout;

namespace dgtk
{

class NewestTask;
class SampleWriter;

/// What the dialog asks of the window.
struct SampleDialogHooks
{
  std::function<bool()> mayReplace;                ///< the scene in the window, after asking about unsaved work
  std::function<void(const LoadedScene&)> prepare; ///< on another thread, before a sample is shown; may be absent
  std::function<bool(LoadedScene)> show;           ///< false: the scene in the window stays, after all
  std::function<void()> keep;
};

/// Draws samples of a random scene, one after the other, on a thread of its own, and says what came of each; the window
/// shows them. Also writes many of them into a folder.
class DGTKRUNS_EXPORT SampleDialog : public QDialog
{
  Q_OBJECT

public:
  SampleDialog(SampleDialogHooks hooks, QWidget* parent);
  /// Waits for a sample that is being drawn, which nobody sees any more.
  ~SampleDialog() override;

  /// Begins with a random scene: its sample 0.
  void openScene(const QString& path);
  /// Whether the window has the sample, so that it can be kept.
  void allowKeeping(bool on);

signals:
  void noted(const QString& line);

private:
  void makeFields(QVBoxLayout* layout);
  void makeLists(QVBoxLayout* layout);
  QWidget* makeButtons();
  void draw();
  void stop();
  void take(DrawnSample drawn);
  void list(const DrawnSample& drawn);
  QString lineOf(const DrawnSample& drawn) const;
  void say(const QString& line);
  void setDrawing(bool on);
  void setFields(int number, std::optional<std::uint64_t> seed);

  SampleDialogHooks Hooks;
  QString Path;
  std::shared_ptr<SampleDrawer> Drawer; ///< touched by the task alone
  std::optional<std::uint64_t> Seed;    ///< chosen instead of the scene's
  int Asked = 0;                        ///< draws so far; answers to others than the last are dropped
  int Shown = 0;                        ///< number of the sample that the fields go back to
  bool Any = false;                     ///< a sample of this scene was shown
  QLabel* File = nullptr;
  QSpinBox* Number = nullptr;
  QDoubleSpinBox* SeedField = nullptr;
  QPushButton* Previous = nullptr;
  QPushButton* Next = nullptr;
  QTreeWidget* Values = nullptr;
  QPlainTextEdit* Notes = nullptr;
  QProgressBar* Progress = nullptr;
  QPushButton* Stop = nullptr;
  QLabel* Status = nullptr;
  QPushButton* Keep = nullptr;
  SampleWriter* Writer = nullptr;
  std::unique_ptr<NewestTask> Task; ///< ends first
};

} // namespace dgtk

#endif
