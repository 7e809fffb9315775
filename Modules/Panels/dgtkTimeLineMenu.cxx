// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineCells.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>

#include <algorithm>
#include <cmath>

namespace dgtk
{

using namespace timeline;

void TimeLineCells::contextMenuEvent(QContextMenuEvent* event)
{
  const int frame = this->State.frame();
  QMenu menu(this);
  menu.setObjectName("timeLineMenu");
  const bool isKey = std::binary_search(this->Shown.keys.begin(), this->Shown.keys.end(), frame);
  const auto add = [&](const char* name, const QString& text, bool possible, const std::function<void()>& act)
  {
    QAction* const action = menu.addAction(text, this, act);
    action->setObjectName(name);
    action->setEnabled(possible);
  };
  add("makeKey", tr("Make &key frame at %1").arg(frame), true, [this] { this->Edits->makeKey(); });
  add("removeKey", tr("&Remove key frame at %1").arg(frame), isKey, [this] { this->Edits->removeKey(); });
  menu.addSeparator();
  add("copyKey", tr("&Copy key frame"), isKey, [this, frame] { this->Copied = frame; });
  const bool canPaste = this->Copied && *this->Copied != frame &&
                        std::binary_search(this->Shown.keys.begin(), this->Shown.keys.end(), *this->Copied);
  const int copied = this->Copied.value_or(0);
  add("pasteKey", tr("&Paste key frame %1 here").arg(copied), canPaste,
    [this, copied] { this->Edits->pasteKey(copied, false); });
  add("moveKey", tr("&Move key frame %1 here").arg(copied), canPaste,
    [this, copied] { this->Edits->pasteKey(copied, true); });
  const Row* const row = this->selectedRow();
  if (row != nullptr)
  {
    menu.addSection(row->name);
    this->Edits->addActions(menu, *row);
  }
  menu.exec(event->reason() == QContextMenuEvent::Keyboard
              ? this->viewport()->mapToGlobal(QPoint(
                  this->Shown.middleOf(frame), row != nullptr ? this->Shown.topOf(*row) + row->height : headerHeight))
              : event->globalPos());
}

void TimeLineCells::shiftKeys(int direction, bool scene, bool copy)
{
  const Row* const row = this->selectedRow();
  const std::vector<int>& keys = scene || row == nullptr ? this->Shown.keys : row->keys;
  Drag drag;
  drag.from.target = scene || row == nullptr ? Target::SceneKey : Target::Key;
  drag.from.frame = drag.to = this->State.frame();
  drag.copy = copy;
  if (!std::binary_search(keys.begin(), keys.end(), drag.to))
  {
    return;
  }
  // Over the keys that are there, which stay.
  do
  {
    drag.to += direction;
  } while (std::binary_search(keys.begin(), keys.end(), drag.to));
  if (drag.to < 0 || drag.to > largestFrame)
  {
    return;
  }
  this->Edits->dragKeys(drag, row == nullptr ? SceneItem() : row->item);
}

void TimeLineCells::shiftBar(int direction, bool start)
{
  const Row* const row = this->selectedRow();
  if (row == nullptr || !row->bar || (!start && std::isinf(row->bar->length)))
  {
    return;
  }
  SequenceBar bar = *row->bar;
  bar.start += start ? direction : 0;
  bar.length = start ? bar.length : std::max(1.0, bar.length + direction);
  this->Edits->changeBar(row->item, bar, start);
}

void TimeLineCells::selectRow(int direction)
{
  const Row* const row = this->selectedRow();
  const std::ptrdiff_t last = std::ptrdiff_t(this->Shown.rows.size()) - 1;
  const std::ptrdiff_t next = row == nullptr ? 0 : (row - this->Shown.rows.data()) + direction;
  if (next >= 0 && next <= last)
  {
    this->State.select({ this->Shown.rows[std::size_t(next)].item });
  }
}

bool TimeLineCells::barKey(const QKeyEvent& event)
{
  const QString text = event.text();
  if (text.size() != 1 || !QString("[]{}").contains(text))
  {
    return false;
  }
  const bool start = text == "[" || text == "]";
  this->shiftBar(text == "[" || text == "{" ? -1 : 1, start);
  return true;
}

bool TimeLineCells::stepKey(const QKeyEvent& event)
{
  if (event.key() != Qt::Key_Left && event.key() != Qt::Key_Right)
  {
    return false;
  }
  const int direction = event.key() == Qt::Key_Left ? -1 : 1;
  const Qt::KeyboardModifiers held = event.modifiers();
  if (held & Qt::AltModifier)
  {
    this->shiftKeys(direction, held & Qt::ShiftModifier, held & Qt::ControlModifier);
  }
  else if (held & Qt::ControlModifier)
  {
    this->goToKey(direction);
  }
  else
  {
    this->State.setFrame(this->State.frame() + direction);
  }
  return true;
}

void TimeLineCells::keyPressEvent(QKeyEvent* event)
{
  if (this->stepKey(*event) || this->barKey(*event))
  {
    return;
  }
  switch (event->key())
  {
    case Qt::Key_Up:
      this->selectRow(-1);
      break;
    case Qt::Key_Down:
      this->selectRow(1);
      break;
    case Qt::Key_Home:
      this->State.setFrame(this->State.scene().firstFrame());
      break;
    case Qt::Key_End:
      this->State.setFrame(this->State.scene().lastFrame());
      break;
    case Qt::Key_Space:
      emit this->playAsked();
      break;
    case Qt::Key_K:
      event->modifiers() & Qt::ShiftModifier ? this->Edits->removeKey() : this->Edits->makeKey();
      break;
    case Qt::Key_Escape:
      this->Dragged.reset();
      this->viewport()->update();
      break;
    default:
      QAbstractScrollArea::keyPressEvent(event);
  }
}

} // namespace dgtk
