// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLine.h"

#include "dgtkTimeLineCells.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QStyle>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr double shortestFrame = 1; // milliseconds

QToolButton* addButton(QWidget* parent, QBoxLayout* layout, const char* name, const QString& tip)
{
  auto* button = new QToolButton(parent);
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setCheckable(true);
  button->setAutoRaise(true);
  layout->addWidget(button);
  return button;
}
} // namespace

TimeLine::TimeLine(EditorState& state, QWidget* parent)
  : QWidget(parent)
  , State(state)
  , Cells(new TimeLineCells(state, this))
  , Clock(new QTimer(this))
{
  auto* controls = new QHBoxLayout;
  this->Play = addButton(this, controls, "play", tr("Play from this frame"));
  this->Play->setIcon(this->style()->standardIcon(QStyle::SP_MediaPlay));
  this->Loop = addButton(this, controls, "loop", tr("Begin again after the last frame"));
  this->Loop->setIcon(this->style()->standardIcon(QStyle::SP_BrowserReload));
  this->Loop->setChecked(true);
  controls->addWidget(new QLabel(tr("Frame"), this));
  this->Frame = new QSpinBox(this);
  this->Frame->setObjectName("frame");
  this->Frame->setRange(0, largestFrame);
  this->Frame->setKeyboardTracking(false);
  controls->addWidget(this->Frame);
  auto* make = new QPushButton(tr("Make key frame"), this);
  make->setObjectName("makeKeyFrame");
  controls->addWidget(make);
  auto* remove = new QPushButton(tr("Remove key frame"), this);
  remove->setObjectName("removeKeyFrame");
  controls->addWidget(remove);
  controls->addStretch(1);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->setSpacing(3);
  layout->addLayout(controls);
  layout->addWidget(this->Cells, 1);

  connect(this->Play, &QToolButton::toggled, this, &TimeLine::play);
  connect(this->Clock, &QTimer::timeout, this, &TimeLine::step);
  connect(this->Frame, QOverload<int>::of(&QSpinBox::valueChanged), &state, &EditorState::setFrame);
  connect(&state, &EditorState::frameChanged, this, &TimeLine::refresh);
  connect(make, &QPushButton::clicked, this->Cells, &TimeLineCells::makeKey);
  connect(remove, &QPushButton::clicked, this->Cells, &TimeLineCells::removeKey);
}

void TimeLine::refresh()
{
  const bool blocked = this->Frame->blockSignals(true);
  this->Frame->setValue(this->State.frame());
  this->Frame->blockSignals(blocked);
}

void TimeLine::play(bool on)
{
  this->Play->setIcon(this->style()->standardIcon(on ? QStyle::SP_MediaPause : QStyle::SP_MediaPlay));
  if (!on)
  {
    this->Clock->stop();
    return;
  }
  if (this->State.frame() >= this->State.scene().lastFrame())
  {
    this->State.setFrame(this->State.scene().firstFrame());
  }
  this->Clock->start(static_cast<int>(std::max(shortestFrame, 1000 / this->State.scene().fps)));
}

void TimeLine::step()
{
  const SceneDescription& scene = this->State.scene();
  if (this->State.frame() < scene.lastFrame())
  {
    this->State.setFrame(this->State.frame() + 1);
  }
  else if (this->Loop->isChecked() && scene.lastFrame() > scene.firstFrame())
  {
    this->State.setFrame(scene.firstFrame());
  }
  else
  {
    this->Play->setChecked(false);
  }
}

} // namespace dgtk
