// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderStatus_h
#define dgtkRenderStatus_h

#include "dgtkRunsModule.h"

#include <QString>
#include <QWidget>

class QProgressBar;
class QPushButton;
class QStatusBar;

namespace dgtk
{

/// A run in the status bar of the window: how far it is, then how it ended until somebody looks. A click asks for more.
class DGTKRUNS_EXPORT RenderStatus : public QWidget
{
  Q_OBJECT

public:
  explicit RenderStatus(QStatusBar* bar);

  /// `fraction`: in [0, 1]; negative before it is known. `left`: time, "" where it is not known.
  void showProgress(double fraction, const QString& left);
  void showEnd(const QString& text, const QString& more);

signals:
  void clicked();

private:
  QPushButton* Text;
  QProgressBar* Bar;
};

} // namespace dgtk

#endif
