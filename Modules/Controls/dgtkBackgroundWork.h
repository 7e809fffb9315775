// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBackgroundWork_h
#define dgtkBackgroundWork_h

#include "dgtkControlsModule.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

class QLabel;
class QProgressBar;
class QPushButton;
class QStatusBar;

namespace dgtk
{

/// Work on a thread of its own while the window goes on: progress in the status bar, with Cancel.
class DGTKCONTROLS_EXPORT BackgroundWork : public QObject
{
  Q_OBJECT

public:
  /// Called by the work, on its thread, with how much is done; false: it is to end.
  using Progress = std::function<bool(std::size_t done, std::size_t total)>;

  BackgroundWork(QStatusBar* bar, QObject* parent);
  /// Waits for work that was cancelled.
  ~BackgroundWork() override;

  /// Returns when the work is done; events are handled meanwhile. False when it was cancelled: the work, which must own
  /// all that it touches, then ends unseen. Throws what the work threw. Not while it is busy.
  bool run(const QString& what, const std::function<void(const Progress&)>& work);
  bool busy() const { return this->Busy; }
  void cancel();

signals:
  void busyChanged(bool busy);

private:
  struct Task;
  void show(const Task& task);
  void setBusy(bool busy);

  QWidget* Panel = nullptr;
  QLabel* What = nullptr;
  QProgressBar* Bar = nullptr;
  std::shared_ptr<Task> Now;
  std::vector<std::shared_ptr<Task>> Left; ///< cancelled, perhaps not ended
  bool Busy = false;
};

} // namespace dgtk

#endif
