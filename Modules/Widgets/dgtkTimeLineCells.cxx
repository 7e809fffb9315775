// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineCells.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QScrollBar>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int cellWidth = 12;
constexpr int rowHeight = 18;
constexpr int headerHeight = 20;
constexpr int namesWidth = 130;
constexpr int numberEvery = 5;
constexpr int fewestFrames = 60;
constexpr int framesAfterLast = 30;
} // namespace

TimeLineCells::TimeLineCells(EditorState& state, QWidget* parent)
  : QAbstractScrollArea(parent)
  , State(state)
{
  this->setObjectName("timeLineCells");
  this->setFocusPolicy(Qt::StrongFocus);
  this->horizontalScrollBar()->setSingleStep(cellWidth);
  this->verticalScrollBar()->setSingleStep(rowHeight);
  connect(&state, &EditorState::changed, this, &TimeLineCells::refresh);
  connect(&state, &EditorState::selectionChanged, this, [this] { this->viewport()->update(); });
  connect(&state, &EditorState::frameChanged, this, &TimeLineCells::showFrame);
  this->refresh();
}

QSize TimeLineCells::sizeHint() const { return { 600, headerHeight + 5 * rowHeight }; }

int TimeLineCells::frames() const
{
  const int last = this->Keys.empty() ? 0 : this->Keys.back();
  return std::max({ fewestFrames, last + framesAfterLast, this->State.frame() + framesAfterLast });
}

int TimeLineCells::leftOf(int frame) const
{
  return namesWidth + frame * cellWidth - this->horizontalScrollBar()->value();
}

int TimeLineCells::frameAt(int x) const
{
  return std::clamp((x - namesWidth + this->horizontalScrollBar()->value()) / cellWidth, 0, largestFrame);
}

void TimeLineCells::refresh()
{
  const SceneDescription& scene = this->State.scene();
  this->Rows.clear();
  for (const SceneItem& item : scene.items())
  {
    this->Rows.push_back({ item, toText(itemName(scene, item)), keyFramesOf(scene, item) });
  }
  this->Keys = scene.keyFrames();
  this->setBars();
  this->viewport()->update();
}

void TimeLineCells::setBars()
{
  const QSize size = this->viewport()->size();
  this->horizontalScrollBar()->setPageStep(size.width() - namesWidth);
  this->horizontalScrollBar()->setRange(0, std::max(0, this->frames() * cellWidth - size.width() + namesWidth));
  this->verticalScrollBar()->setPageStep(size.height() - headerHeight);
  this->verticalScrollBar()->setRange(
    0, std::max(0, int(this->Rows.size()) * rowHeight - size.height() + headerHeight));
}

void TimeLineCells::resizeEvent(QResizeEvent* event)
{
  QAbstractScrollArea::resizeEvent(event);
  this->setBars();
}

void TimeLineCells::showFrame()
{
  this->setBars();
  const int left = this->leftOf(this->State.frame());
  QScrollBar* const bar = this->horizontalScrollBar();
  if (left < namesWidth)
  {
    bar->setValue(bar->value() + left - namesWidth);
  }
  else if (left + cellWidth > this->viewport()->width())
  {
    bar->setValue(bar->value() + left + cellWidth - this->viewport()->width());
  }
  this->viewport()->update();
}

void TimeLineCells::paintHeader(QPainter& painter) const
{
  const int width = this->viewport()->width();
  painter.fillRect(0, 0, width, headerHeight, this->palette().button());
  painter.setClipRect(namesWidth, 0, width - namesWidth, headerHeight);
  painter.setPen(this->palette().color(QPalette::ButtonText));
  const int first = this->frameAt(namesWidth) / numberEvery * numberEvery;
  for (int frame = first; this->leftOf(frame) < width; frame += numberEvery)
  {
    const int left = this->leftOf(frame);
    painter.drawText(QRect(left + 2, 0, numberEvery * cellWidth, headerHeight - 4), Qt::AlignLeft | Qt::AlignVCenter,
      QString::number(frame));
    painter.drawLine(left, headerHeight - 6, left, headerHeight);
  }
  for (const int key : this->Keys)
  {
    painter.fillRect(this->leftOf(key) + 1, headerHeight - 4, cellWidth - 1, 4, QColor(230, 160, 40));
  }
  painter.setClipping(false);
}

void TimeLineCells::paintRow(QPainter& painter, int top, const Row& row) const
{
  const int width = this->viewport()->width();
  const bool selected = this->State.isSelected(row.item);
  const QPalette& palette = this->palette();
  painter.fillRect(0, top, width, rowHeight, selected ? palette.highlight() : palette.base());
  painter.setPen(palette.color(selected ? QPalette::HighlightedText : QPalette::Text));
  const QString name = painter.fontMetrics().elidedText(row.name, Qt::ElideRight, namesWidth - 10);
  painter.drawText(QRect(6, top, namesWidth - 8, rowHeight), Qt::AlignLeft | Qt::AlignVCenter, name);

  painter.setClipRect(namesWidth, top, width - namesWidth, rowHeight);
  painter.setPen(palette.color(QPalette::Midlight));
  for (int frame = this->frameAt(namesWidth); this->leftOf(frame) < width; ++frame)
  {
    painter.drawLine(this->leftOf(frame), top, this->leftOf(frame), top + rowHeight);
  }
  if (row.keys.size() > 1)
  {
    const QRect span(QPoint(this->leftOf(row.keys.front()) + cellWidth / 2, top + rowHeight / 2 - 1),
      QPoint(this->leftOf(row.keys.back()) + cellWidth / 2, top + rowHeight / 2));
    painter.fillRect(span, palette.color(selected ? QPalette::HighlightedText : QPalette::Dark));
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(palette.color(selected ? QPalette::HighlightedText : QPalette::Text));
  for (const int key : row.keys)
  {
    painter.drawEllipse(QPointF(this->leftOf(key) + cellWidth / 2.0, top + rowHeight / 2.0), 4, 4);
  }
  painter.setClipping(false);
  painter.setPen(palette.color(QPalette::Mid));
  painter.drawLine(0, top + rowHeight - 1, width, top + rowHeight - 1);
}

void TimeLineCells::paintEvent(QPaintEvent*)
{
  QPainter painter(this->viewport());
  painter.setRenderHint(QPainter::Antialiasing, false);
  const QSize size = this->viewport()->size();
  painter.fillRect(this->viewport()->rect(), this->palette().window());
  if (this->Rows.empty())
  {
    const int margin = namesWidth + 3 * cellWidth;
    painter.drawText(QRect(margin, headerHeight, size.width() - margin - cellWidth, size.height() - headerHeight),
      Qt::AlignVCenter | Qt::AlignLeft | Qt::TextWordWrap,
      tr("Objects, lights and cameras get rows here. Right-click a frame to make a key frame."));
  }
  const int offset = this->verticalScrollBar()->value();
  for (std::size_t i = std::size_t(offset / rowHeight); i < this->Rows.size(); ++i)
  {
    const int top = headerHeight + int(i) * rowHeight - offset;
    if (top > size.height())
    {
      break;
    }
    this->paintRow(painter, top, this->Rows[i]);
  }
  this->paintHeader(painter);
  painter.setPen(this->palette().color(QPalette::Mid));
  painter.drawLine(namesWidth - 1, 0, namesWidth - 1, size.height());
  const int left = this->leftOf(this->State.frame());
  if (left >= namesWidth)
  {
    painter.fillRect(left, 0, cellWidth, size.height(), QColor(220, 50, 50, 70));
    painter.fillRect(left + cellWidth / 2, 0, 1, size.height(), QColor(220, 50, 50));
  }
}

void TimeLineCells::mousePressEvent(QMouseEvent* event)
{
  const std::size_t row =
    std::size_t(std::max(0, event->pos().y() - headerHeight + this->verticalScrollBar()->value()) / rowHeight);
  if (event->pos().x() >= namesWidth)
  {
    this->State.setFrame(this->frameAt(event->pos().x()));
  }
  if (event->pos().y() >= headerHeight && row < this->Rows.size())
  {
    this->State.select({ this->Rows[row].item });
  }
}

void TimeLineCells::mouseMoveEvent(QMouseEvent* event)
{
  if (event->buttons() & Qt::LeftButton && event->pos().x() >= namesWidth)
  {
    this->State.setFrame(this->frameAt(event->pos().x()));
  }
}

void TimeLineCells::contextMenuEvent(QContextMenuEvent* event)
{
  const int frame = this->State.frame();
  QMenu menu(this);
  const bool isKey = std::binary_search(this->Keys.begin(), this->Keys.end(), frame);
  menu.addAction(tr("Make key frame at %1").arg(frame), this, &TimeLineCells::makeKey);
  menu.addAction(tr("Remove key frame at %1").arg(frame), this, &TimeLineCells::removeKey)->setEnabled(isKey);
  menu.addSeparator();
  menu.addAction(tr("Copy key frame"), this, [this, frame] { this->Copied = frame; })->setEnabled(isKey);
  const bool canPaste =
    this->Copied && *this->Copied != frame && std::binary_search(this->Keys.begin(), this->Keys.end(), *this->Copied);
  const int copied = this->Copied.value_or(0);
  menu.addAction(tr("Paste key frame %1 here").arg(copied), this, [this] { this->pasteKey(false); })
    ->setEnabled(canPaste);
  menu.addAction(tr("Move key frame %1 here").arg(copied), this, [this] { this->pasteKey(true); })
    ->setEnabled(canPaste);
  this->addInterpolations(menu);
  menu.exec(event->globalPos());
}

void TimeLineCells::pasteKey(bool move)
{
  const int from = *this->Copied;
  const int to = this->State.frame();
  this->State.attempt(
    [&]
    {
      this->State.document().edit(move ? "Move key frame" : "Paste key frame",
        [&](SceneDescription& scene)
        {
          copyKeyFrame(scene, from, to);
          if (move)
          {
            removeKeyFrame(scene, from);
          }
        });
    });
}

void TimeLineCells::addInterpolations(QMenu& menu)
{
  if (this->State.selection().empty())
  {
    return;
  }
  const SceneItem item = this->State.selection().front();
  QMenu* const kinds = menu.addMenu(tr("Between the keys of %1").arg(toText(itemName(this->State.scene(), item))));
  kinds->setEnabled(!keyFramesOf(this->State.scene(), item).empty());
  const QString names[3] = { tr("Linear"), tr("Steps"), tr("Smooth") };
  for (const Interpolation kind : { Interpolation::Linear, Interpolation::Step, Interpolation::Smooth })
  {
    QAction* const action = kinds->addAction(names[static_cast<int>(kind)], this,
      [this, item, kind]
      {
        this->State.attempt(
          [&]
          {
            this->State.document().editItem(
              "Change interpolation", item, [&](SceneDescription& scene) { setInterpolation(scene, item, kind); });
          });
      });
    action->setCheckable(true);
    action->setChecked(interpolationOf(this->State.scene(), item) == kind);
  }
}

void TimeLineCells::keyPressEvent(QKeyEvent* event)
{
  switch (event->key())
  {
    case Qt::Key_Left:
      this->State.setFrame(this->State.frame() - 1);
      break;
    case Qt::Key_Right:
      this->State.setFrame(this->State.frame() + 1);
      break;
    case Qt::Key_Home:
      this->State.setFrame(this->State.scene().firstFrame());
      break;
    case Qt::Key_End:
      this->State.setFrame(this->State.scene().lastFrame());
      break;
    default:
      QAbstractScrollArea::keyPressEvent(event);
  }
}

void TimeLineCells::makeKey()
{
  const int frame = this->State.frame();
  this->State.attempt(
    [this, frame] {
      this->State.document().edit("Make key frame", [frame](SceneDescription& scene) { makeKeyFrame(scene, frame); });
    });
}

void TimeLineCells::removeKey()
{
  const int frame = this->State.frame();
  this->State.attempt(
    [this, frame]
    {
      this->State.document().edit(
        "Remove key frame", [frame](SceneDescription& scene) { removeKeyFrame(scene, frame); });
    });
}

} // namespace dgtk
