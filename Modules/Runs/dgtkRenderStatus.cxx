// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderStatus.h"

#include <QHBoxLayout>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>

namespace dgtk
{

namespace
{
constexpr int barWidth = 100; // pixels
constexpr int wholeBar = 1000;
} // namespace

RenderStatus::RenderStatus(QStatusBar* bar)
  : QWidget(bar)
  , Text(new QPushButton(this))
  , Bar(new QProgressBar(this))
{
  this->setObjectName("renderStatus");
  this->Text->setObjectName("renderStatusText");
  this->Text->setFlat(true);
  this->Text->setFocusPolicy(Qt::NoFocus);
  this->Bar->setObjectName("renderStatusProgress");
  this->Bar->setFixedWidth(barWidth);
  this->Bar->setTextVisible(false);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Text);
  layout->addWidget(this->Bar);
  this->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  bar->addPermanentWidget(this);
  this->hide();
  connect(this->Text, &QPushButton::clicked, this, &RenderStatus::clicked);
}

void RenderStatus::showProgress(double fraction, const QString& left)
{
  this->Bar->setRange(0, fraction < 0 ? 0 : wholeBar);
  this->Bar->setValue(int(wholeBar * fraction));
  this->Bar->show();
  const QString percent = QString::number(int(100 * fraction));
  this->Text->setText(fraction < 0     ? tr("Rendering ...")
                      : left.isEmpty() ? tr("Rendering: %1 %").arg(percent)
                                       : tr("Rendering: %1 %, %2 left").arg(percent, left));
  this->Text->setToolTip(tr("Click for the render configuration"));
  this->show();
}

void RenderStatus::showEnd(const QString& text, const QString& more)
{
  this->Bar->hide();
  this->Text->setText(text);
  this->Text->setToolTip(more);
  this->show();
}

} // namespace dgtk
