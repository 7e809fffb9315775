// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLegendBar.h"

#include "dgtkEditorLanguage.h"
#include "dgtkNumberBox.h"
#include "dgtkNumberRow.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QHelpEvent>
#include <QLineEdit>
#include <QPainter>
#include <QToolButton>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int stripHeight = 20;
constexpr int swatchSide = 10;
constexpr int gap = 6;
constexpr int digits = 4;
constexpr int narrowest = 260;   // widget units, with fields
constexpr int tickDistance = 64; // widget units

QColor toQt(Rgb color) { return { color[0], color[1], color[2] }; }

QString text(double value) { return QString::number(value, 'g', digits); }

/// The sentences of colorPicture(), which knows no translation.
const char* const sentences[] = { QT_TRANSLATE_NOOP(
                                    "dgtk::LegendStrip", "red right, green up, blue towards the camera"),
  QT_TRANSLATE_NOOP("dgtk::LegendStrip", "red u, green v, without whole numbers"),
  QT_TRANSLATE_NOOP("dgtk::LegendStrip", "red x, green y, over the range of each"),
  QT_TRANSLATE_NOOP("dgtk::LegendStrip", "red x, green y, blue z, over the range of each"),
  QT_TRANSLATE_NOOP("dgtk::LegendStrip", "each id has a colour of its own") };

QString translated(const std::string& sentence)
{
  for (const char* const known : sentences)
  {
    if (sentence == known)
    {
      return LegendStrip::tr(known);
    }
  }
  return QString::fromStdString(sentence);
}

double luminance(const QColor& c) { return 0.3 * c.redF() + 0.59 * c.greenF() + 0.11 * c.blueF(); }
} // namespace

LegendStrip::LegendStrip(QWidget* parent)
  : QWidget(parent)
{
  this->setObjectName("legend");
  this->setFixedHeight(stripHeight);
  this->setMinimumWidth(40);
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void LegendStrip::setPicture(const ShownPointer& shown)
{
  this->Shown = shown;
  this->update();
}

void LegendStrip::setEnds(bool on)
{
  this->Ends = on;
  this->update();
}

void LegendStrip::drawRamp(QPainter& painter) const
{
  const PictureLegend& legend = this->Shown->colors.legend;
  const PictureValues& picture = *this->Shown->picture;
  const int width = this->width();
  for (int x = 0; x < width; ++x)
  {
    painter.setPen(toQt(legendColor(picture, legend, (x + 0.5) / width)));
    painter.drawLine(x, 2, x, this->height() - 3);
  }
  const bool logarithmic = legendIsLogarithmic(picture, legend);
  const int ticks = std::max(1, width / tickDistance);
  for (int i = this->Ends ? 0 : 1; i <= (this->Ends ? ticks : ticks - 1); ++i)
  {
    const double at = double(i) / ticks;
    const auto [low, high] = legend.range;
    const double value = logarithmic ? low * std::pow(high / low, at) : low + at * (high - low);
    const QRectF place(
      std::clamp(at * width - tickDistance / 2.0, 2.0, width - tickDistance - 2.0), 0, tickDistance, this->height());
    const int side = i == 0 ? Qt::AlignLeft : i == ticks ? Qt::AlignRight : Qt::AlignHCenter;
    painter.setPen(luminance(toQt(legendColor(picture, legend, at))) > 0.5 ? Qt::black : Qt::white);
    painter.drawText(place, side | Qt::AlignVCenter, text(value));
  }
}

void LegendStrip::drawSwatches(QPainter& painter) const
{
  const PictureLegend& legend = this->Shown->colors.legend;
  const QFontMetrics metrics = painter.fontMetrics();
  std::size_t hidden = legend.hidden + legend.swatches.size();
  int x = 2;
  for (const PictureLegend::Swatch& swatch : legend.swatches)
  {
    const QString name = QString::fromStdString(swatch.text);
    const int width = swatchSide + 4 + metrics.horizontalAdvance(name) + 2 * gap;
    const int rest = hidden > 1 ? metrics.horizontalAdvance(tr("+%1").arg(hidden)) + 2 : 0;
    if (x + width + rest > this->width())
    {
      break;
    }
    painter.fillRect(x, (this->height() - swatchSide) / 2, swatchSide, swatchSide, toQt(swatch.color));
    painter.setPen(this->palette().color(QPalette::WindowText));
    painter.drawText(x + swatchSide + 4, 0, width, this->height(), Qt::AlignVCenter, name);
    x += width;
    --hidden;
  }
  painter.setPen(this->palette().color(QPalette::WindowText));
  if (hidden > 0)
  {
    painter.drawText(x, 0, this->width() - x, this->height(), Qt::AlignVCenter, tr("+%1").arg(hidden));
  }
}

void LegendStrip::drawWheel(QPainter& painter) const
{
  const int side = this->height() - 2;
  QImage wheel(side, side, QImage::Format_ARGB32_Premultiplied);
  wheel.fill(Qt::transparent);
  const double radius = side / 2.0;
  for (int y = 0; y < wheel.height(); ++y)
  {
    for (int x = 0; x < wheel.width(); ++x)
    {
      const double dx = (x + 0.5 - radius) / radius;
      const double dy = (y + 0.5 - radius) / radius;
      if (std::hypot(dx, dy) <= 1)
      {
        wheel.setPixelColor(x, y, toQt(wheelColor(dx, dy)));
      }
    }
  }
  painter.drawImage(QPointF(2, 1), wheel);
  painter.setPen(this->palette().color(QPalette::WindowText));
  const PictureLegend& legend = this->Shown->colors.legend;
  const QString whole = tr("full colour: %1 %2").arg(text(legend.range.high), unitText(legend.unit));
  const int left = side + 2 * gap;
  painter.drawText(QRectF(left, 0, this->width() - left, this->height()), Qt::AlignVCenter,
    painter.fontMetrics().elidedText(whole, Qt::ElideRight, this->width() - left));
}

void LegendStrip::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  QFont small = this->font();
  small.setPointSizeF(small.pointSizeF() * 0.85);
  painter.setFont(small);
  if (!this->Shown || !this->Shown->picture)
  {
    return;
  }
  const PictureLegend& legend = this->Shown->colors.legend;
  switch (legend.kind)
  {
    case PictureLegend::Kind::Ramp:
      return this->drawRamp(painter);
    case PictureLegend::Kind::Wheel:
      return this->drawWheel(painter);
    case PictureLegend::Kind::Swatches:
      if (!legend.swatches.empty())
      {
        return this->drawSwatches(painter);
      }
      break;
    default:
      break;
  }
  painter.setPen(this->palette().color(QPalette::WindowText));
  const QString whole = translated(legend.text);
  painter.drawText(this->rect().adjusted(2, 0, 0, 0), Qt::AlignVCenter,
    painter.fontMetrics().elidedText(whole, Qt::ElideRight, this->width() - 4));
}

QString LegendStrip::longText() const
{
  if (!this->Shown)
  {
    return {};
  }
  const PictureLegend& legend = this->Shown->colors.legend;
  QString all = translated(legend.text).toHtmlEscaped();
  for (const PictureLegend::Swatch& swatch : legend.swatches)
  {
    all += QString("<span style='color:%1'>&#9632;</span> %2<br>")
             .arg(toQt(swatch.color).name(), QString::fromStdString(swatch.text).toHtmlEscaped());
  }
  return legend.hidden > 0 ? all + tr("and %1 more").arg(legend.hidden) : all;
}

bool LegendStrip::event(QEvent* event)
{
  if (event->type() == QEvent::ToolTip)
  {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), this->longText(), this);
    return true;
  }
  return QWidget::event(event);
}

LegendBar::LegendBar(QWidget* parent)
  : QWidget(parent)
  , Strip(new LegendStrip(this))
  , Auto(new QToolButton(this))
{
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  layout->setSizeConstraint(QLayout::SetNoConstraint); // narrow panes do without the fields
  this->setMinimumWidth(60);
  const char* const names[] = { "low", "high" };
  const QString tips[] = { tr("Lower end of the colours"), tr("Upper end of the colours") };
  for (int end = 0; end < 2; ++end)
  {
    auto* field = this->Ends[end] = new QLineEdit(this);
    field->setObjectName(names[end]);
    field->setToolTip(tips[end]);
    field->setAccessibleName(tips[end]);
    field->setFixedWidth(field->fontMetrics().horizontalAdvance("-0.0000e-00") + 4);
    connect(field, &QLineEdit::editingFinished, this, &LegendBar::ask);
  }
  this->Auto->setObjectName("auto");
  this->Auto->setText(tr("Auto"));
  this->Auto->setToolTip(tr("Colours over the range of each picture"));
  this->Auto->setCheckable(true);
  this->Auto->setAutoRaise(true);
  // the same for all, so that pictures side by side have one size
  this->setFixedHeight(this->Ends[0]->sizeHint().height());
  layout->addWidget(this->Ends[0]);
  layout->addWidget(this->Strip, 1);
  layout->addWidget(this->Ends[1]);
  layout->addWidget(this->Auto);
  connect(this->Auto, &QToolButton::clicked, this,
    [this](bool on) { emit this->rangeAsked(on ? std::nullopt : std::optional<PictureRange>(this->Shown)); });
  this->setPicture(nullptr, false);
}

void LegendBar::setPicture(const ShownPointer& shown, bool chosen)
{
  const PictureLegend legend = shown ? shown->colors.legend : PictureLegend();
  this->Strip->setPicture(shown);
  this->Auto->setChecked(!chosen);
  this->HasRange = legend.hasRange;
  this->HasLow = legend.kind == PictureLegend::Kind::Ramp;
  this->showFields();
  this->Shown = legend.range;
  const double ends[] = { legend.range.low, legend.range.high };
  for (int end = 0; end < 2; ++end)
  {
    if (!this->Ends[end]->hasFocus() || !this->Ends[end]->isModified())
    {
      this->Ends[end]->setText(text(ends[end]));
      this->Ends[end]->setCursorPosition(0);
      this->Ends[end]->setModified(false);
    }
  }
}

void LegendBar::ask()
{
  for (QLineEdit* field : this->Ends)
  {
    if (field->isModified() && !numberOf(field->text()))
    {
      tell(*field, tr("\"%1\" is no number: the one before comes back").arg(field->text()));
      field->setText(text(field == this->Ends[0] ? this->Shown.low : this->Shown.high));
      field->setModified(false);
    }
  }
  if (!this->Ends[0]->isModified() && !this->Ends[1]->isModified())
  {
    return;
  }
  PictureRange range = this->Shown;
  range.low = this->Ends[0]->isModified() ? *numberOf(this->Ends[0]->text()) : range.low;
  range.high = this->Ends[1]->isModified() ? *numberOf(this->Ends[1]->text()) : range.high;
  this->Ends[0]->setModified(false);
  this->Ends[1]->setModified(false);
  if (range.low > range.high)
  {
    std::swap(range.low, range.high);
  }
  this->Shown = range;
  emit this->rangeAsked(range);
}

void LegendBar::showFields()
{
  const bool wide = this->width() >= narrowest;
  this->Auto->setVisible(this->HasRange && wide);
  this->Ends[0]->setVisible(this->HasRange && this->HasLow && wide);
  this->Ends[1]->setVisible(this->HasRange && wide);
  this->Strip->setEnds(!wide);
}

void LegendBar::resizeEvent(QResizeEvent*) { this->showFields(); }

} // namespace dgtk
