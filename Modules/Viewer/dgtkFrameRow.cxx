// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameRow.h"

#include "dgtkNumberBox.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QToolButton>

namespace dgtk
{

FrameRow::FrameRow(const QList<QAction*>& buttons, QAction* play, std::function<bool()> ready, QWidget* parent)
  : QWidget(parent)
  , Play(play)
  , Ready(std::move(ready))
  , Frames(new QSlider(Qt::Horizontal, this))
  , Text(new QLabel(this))
  , Rate(new NumberBox<QSpinBox>(this))
  , Loop(new QToolButton(this))
{
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  for (QAction* const action : buttons)
  {
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    layout->addWidget(button);
  }
  this->Loop->setObjectName("loop");
  this->Loop->setText(tr("Loop"));
  this->Loop->setCheckable(true);
  this->Frames->setObjectName("frames");
  this->Frames->setAccessibleName(tr("Frame"));
  this->Text->setObjectName("frameText");
  this->Rate->setObjectName("rate");
  this->Rate->setRange(1, 60);
  this->Rate->setSuffix(tr(" fps"));
  this->Rate->setToolTip(tr("Frames a second"));
  connect(this->Rate, QOverload<int>::of(&QSpinBox::valueChanged), this,
    [this](int rate) { this->Player.setInterval(1000 / rate); });
  connect(this->Frames, &QSlider::valueChanged, this, &FrameRow::changed);
  connect(this->Play, &QAction::toggled, this, &FrameRow::play);
  connect(&this->Player, &QTimer::timeout, this, &FrameRow::playNext);
  layout->addWidget(this->Loop);
  layout->addWidget(this->Frames, 1);
  layout->addWidget(this->Text);
  layout->addWidget(this->Rate);
}

void FrameRow::setCount(int count)
{
  this->Play->setChecked(false);
  this->Count = count;
  this->Frames->setRange(0, count - 1);
  this->Frames->setValue(0);
}

int FrameRow::index() const { return this->Frames->value(); }
void FrameRow::setIndex(int index) { this->Frames->setValue(index); }
int FrameRow::last() const { return this->Frames->maximum(); }
void FrameRow::setText(const QString& text) { this->Text->setText(text); }
int FrameRow::rate() const { return this->Rate->value(); }
void FrameRow::setRate(int framesASecond) { this->Rate->setValue(framesASecond); }

void FrameRow::play(bool on)
{
  if (!on || this->Count == 0)
  {
    this->Player.stop();
    return;
  }
  if (this->index() == this->last())
  {
    this->setIndex(0);
  }
  emit this->advanced();
  this->Player.start(1000 / this->rate());
}

void FrameRow::playNext()
{
  if (!this->Ready())
  {
    return; // reading is slower than playing
  }
  if (this->index() == this->last() && !this->Loop->isChecked())
  {
    this->Play->setChecked(false);
    return;
  }
  this->setIndex(this->next());
  emit this->advanced();
}

} // namespace dgtk
