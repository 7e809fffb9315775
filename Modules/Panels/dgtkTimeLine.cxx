// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLine.h"

#include "dgtkEditorIcons.h"
#include "dgtkNumberBox.h"
#include "dgtkNumberRow.h"
#include "dgtkTimeLineCells.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QStyle>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

#include <cmath>

namespace dgtk
{

namespace
{
constexpr int drawEvery = 10;   // milliseconds
constexpr int rateDecimals = 3; // film and television: 23.976
constexpr double slowest = 0.001;
constexpr double fastest = 1e6; // the most that a scene may have
constexpr int narrowest = 80;   // pixels of a field, where the window is narrow
constexpr int narrowButton = 34;
constexpr int arrows = 34; // of a number field, with its borders
} // namespace

QToolButton* TimeLine::addButton(QBoxLayout* layout, const char* name, int icon, const QString& tip)
{
  auto* button = new QToolButton(this);
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setIcon(this->style()->standardIcon(static_cast<QStyle::StandardPixmap>(icon)));
  button->setAutoRaise(true);
  layout->addWidget(button);
  return button;
}

void TimeLine::addFrameFields(QBoxLayout* layout)
{
  layout->addWidget(new QLabel(tr("Frame"), this));
  this->Frame = new NumberBox<QSpinBox>(this);
  this->Frame->setObjectName("frame");
  this->Frame->setRange(0, largestFrame);
  leaveUndo(this->Frame);
  layout->addWidget(this->Frame);
  this->Rate = new NumberBox<QDoubleSpinBox>(this);
  this->Rate->setObjectName("frameRate");
  this->Rate->setDecimals(rateDecimals);
  this->Rate->setRange(slowest, fastest);
  this->Rate->setSuffix(tr(" frames/s"));
  this->Rate->setMinimumWidth(narrowest);
  this->Rate->setMaximumWidth(this->Rate->fontMetrics().horizontalAdvance("1000.000" + this->Rate->suffix()) + arrows);
  this->Rate->setToolTip(tr("The scene's frame rate: of playing, and of the models' sequences"));
  leaveUndo(this->Rate);
  layout->addWidget(this->Rate);
  connect(this->Frame, QOverload<int>::of(&QSpinBox::valueChanged), &this->State, &EditorState::setFrame);
  connect(this->Rate, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double rate)
    {
      this->State.attempt(
        [&] { this->State.document().edit("Change frame rate", [&](SceneDescription& scene) { scene.fps = rate; }); });
      this->refreshRate();
    });
}

QPushButton* TimeLine::addKeyButton(const char* name, const char* icon, const QString& text)
{
  auto* button = new QPushButton(text, this);
  button->setObjectName(name);
  button->setMinimumWidth(narrowButton);
  button->setToolTip(QString(text).remove('&'));
  button->setAccessibleName(button->toolTip()); // also where there is room for its icon only
  this->Controls->addWidget(button);
  button->ensurePolished();
  this->KeyButtons.push_back({ button, editorIcon(icon), text, button->sizeHint().width() });
  return button;
}

void TimeLine::resizeEvent(QResizeEvent* event)
{
  QWidget::resizeEvent(event);
  const QMargins margins = this->layout()->contentsMargins();
  int needed = this->Controls->sizeHint().width() + margins.left() + margins.right();
  for (const KeyButton& key : this->KeyButtons)
  {
    needed += key.width - key.button->sizeHint().width();
  }
  for (const KeyButton& key : this->KeyButtons)
  {
    key.button->setText(needed <= this->width() ? key.text : QString());
    key.button->setIcon(needed <= this->width() ? QIcon() : key.icon);
    key.button->setShortcut(QKeySequence::mnemonic(key.text));
  }
}

TimeLine::TimeLine(EditorState& state, QWidget* parent)
  : QWidget(parent)
  , State(state)
  , Cells(new TimeLineCells(state, this))
  , Clock(new QTimer(this))
{
  this->Controls = new QHBoxLayout;
  QHBoxLayout* const controls = this->Controls;
  QToolButton* const back =
    this->addButton(controls, "previousKey", QStyle::SP_MediaSkipBackward, tr("To the key frame before (Ctrl+Left)"));
  this->Play = this->addButton(controls, "play", QStyle::SP_MediaPlay, tr("Play from this frame (Space)"));
  this->Play->setCheckable(true);
  QToolButton* const on =
    this->addButton(controls, "nextKey", QStyle::SP_MediaSkipForward, tr("To the next key frame (Ctrl+Right)"));
  this->Loop = this->addButton(controls, "loop", QStyle::SP_BrowserReload, tr("Begin again after the last frame"));
  this->Loop->setCheckable(true);
  this->Loop->setChecked(true);
  this->addFrameFields(controls);
  QPushButton* const make = this->addKeyButton("makeKeyFrame", "keyFrame", tr("Make &key frame"));
  QPushButton* const remove = this->addKeyButton("removeKeyFrame", "removeKeyFrame", tr("&Remove key frame"));
  controls->addStretch(1);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->setSpacing(3);
  layout->addLayout(controls);
  layout->addWidget(this->Cells, 1);

  connect(this->Play, &QToolButton::toggled, this, &TimeLine::play);
  connect(this->Cells, &TimeLineCells::playAsked, this->Play, &QToolButton::toggle);
  connect(this->Clock, &QTimer::timeout, this, &TimeLine::step);
  connect(back, &QToolButton::clicked, this->Cells, [this] { this->Cells->goToKey(-1); });
  connect(on, &QToolButton::clicked, this->Cells, [this] { this->Cells->goToKey(1); });
  connect(&state, &EditorState::frameChanged, this, &TimeLine::refresh);
  connect(&state, &EditorState::changed, this, &TimeLine::refreshRate);
  connect(&state, &EditorState::typingEnds, this->Rate, &QAbstractSpinBox::interpretText);
  connect(make, &QPushButton::clicked, this->Cells, &TimeLineCells::makeKey);
  connect(remove, &QPushButton::clicked, this->Cells, &TimeLineCells::removeKey);
  this->refreshRate();
}

void TimeLine::refreshRate()
{
  const bool blocked = this->Rate->blockSignals(true);
  this->Rate->setValue(this->State.scene().fps);
  this->Rate->blockSignals(blocked);
}

void TimeLine::refresh()
{
  const bool blocked = this->Frame->blockSignals(true);
  this->Frame->setValue(this->State.frame());
  if (this->Clock->isActive() && !this->Stepping)
  {
    this->PlayedFrom = this->State.frame(); // scrubbed meanwhile
    this->Playing.restart();
  }
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
  this->PlayedFrom = this->State.frame();
  this->Playing.start();
  this->Clock->start(drawEvery);
}

void TimeLine::step()
{
  const SceneDescription& scene = this->State.scene();
  const double passed = double(this->Playing.elapsed()) * scene.fps / 1000;
  const double frame = this->PlayedFrom + std::floor(passed);
  const QScopedValueRollback<bool> own(this->Stepping, true);
  if (frame <= scene.lastFrame())
  {
    this->State.setFrame(int(frame));
  }
  else if (this->Loop->isChecked() && scene.lastFrame() > scene.firstFrame())
  {
    this->PlayedFrom = scene.firstFrame();
    this->Playing.restart();
    this->State.setFrame(this->PlayedFrom);
  }
  else
  {
    this->State.setFrame(scene.lastFrame());
    this->Play->setChecked(false);
  }
}

} // namespace dgtk
