// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFrameRow_h
#define dgtkFrameRow_h

#include <QTimer>
#include <QWidget>

#include <functional>

class QAction;
class QLabel;
class QSlider;
class QSpinBox;
class QToolButton;

namespace dgtk
{

/// Which frame is shown, and playing. Indices count the frames of the dataset from 0.
class FrameRow : public QWidget
{
  Q_OBJECT

public:
  /// `buttons`: with `play`, which can be checked, among them. While playing, a frame waits until `ready`.
  FrameRow(const QList<QAction*>& buttons, QAction* play, std::function<bool()> ready, QWidget* parent);

  void setCount(int count);
  int index() const;
  void setIndex(int index);
  void step(int by) { this->setIndex(this->index() + by); }
  int last() const;
  /// The one that playing comes to.
  int next() const { return (this->index() + 1) % (this->last() + 1); }
  void setText(const QString& text);
  int rate() const;
  void setRate(int framesASecond);

signals:
  void changed();
  /// The next frame will be wanted.
  void advanced();

private:
  void play(bool on);
  void playNext();

  QAction* Play;
  std::function<bool()> Ready;
  QTimer Player;
  QSlider* Frames;
  QLabel* Text;
  QSpinBox* Rate;
  QToolButton* Loop;
  int Count = 0;
};

} // namespace dgtk

#endif
