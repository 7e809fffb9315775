// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNamedAction.h"
#include "dgtkTimeLineCells.h"
#include "dgtkTimeLineSizes.h"

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
  const bool isKey = std::binary_search(this->Keys.begin(), this->Keys.end(), frame);
  const auto add = [&](const char* name, const QString& text, bool possible, const std::function<void()>& act)
  {
    QAction* const action = menu.addAction(text, this, act);
    action->setObjectName(name);
    action->setEnabled(possible);
  };
  add("makeKey", tr("Make &key frame at %1").arg(frame), true, [this] { this->makeKey(); });
  add("removeKey", tr("&Remove key frame at %1").arg(frame), isKey, [this] { this->removeKey(); });
  menu.addSeparator();
  add("copyKey", tr("&Copy key frame"), isKey, [this, frame] { this->Copied = frame; });
  const bool canPaste =
    this->Copied && *this->Copied != frame && std::binary_search(this->Keys.begin(), this->Keys.end(), *this->Copied);
  const int copied = this->Copied.value_or(0);
  add("pasteKey", tr("&Paste key frame %1 here").arg(copied), canPaste, [this] { this->pasteKey(false); });
  add("moveKey", tr("&Move key frame %1 here").arg(copied), canPaste, [this] { this->pasteKey(true); });
  const Row* const row = this->selectedRow();
  if (row != nullptr)
  {
    menu.addSection(row->name);
    this->addKeyActions(menu, *row);
    this->addInterpolations(menu, *row);
    this->addSequences(menu, *row);
  }
  menu.exec(event->reason() == QContextMenuEvent::Keyboard
              ? this->viewport()->mapToGlobal(
                  QPoint(this->middleOf(frame), row != nullptr ? this->topOf(*row) + row->height : headerHeight))
              : event->globalPos());
}

void TimeLineCells::addKeyActions(QMenu& menu, const Row& row)
{
  const int frame = this->State.frame();
  const SceneItem item = row.item;
  const auto key = keyInterpolationOf(this->State.scene(), item, frame);
  QAction* const remove = menu.addAction(tr("Remove &its keys at %1").arg(frame), this,
    [this, item, frame]
    { this->edit("Remove keys", [&](SceneDescription& scene) { removeItemKeys(scene, item, frame); }); });
  remove->setObjectName("removeItemKeys");
  remove->setEnabled(key.has_value());
  QMenu* const kinds = menu.addMenu(tr("&From its key at %1 to the next").arg(frame));
  kinds->setObjectName("keyInterpolation");
  kinds->setEnabled(key.has_value());
  const auto add = [&](const QString& text, std::optional<Interpolation> kind, bool checked)
  {
    QAction* const action = kinds->addAction(text, this,
      [this, item, frame, kind]
      {
        this->edit("Change interpolation of keys",
          [&](SceneDescription& scene) { setKeyInterpolation(scene, item, frame, kind); });
      });
    action->setCheckable(true);
    action->setChecked(checked);
  };
  add(tr("&As its other keys"), std::nullopt, key && !key->own);
  add(tr("&Linear"), Interpolation::Linear, key && key->own && key->kind == Interpolation::Linear);
  add(tr("&Steps"), Interpolation::Step, key && key->own && key->kind == Interpolation::Step);
  add(tr("S&mooth"), Interpolation::Smooth, key && key->own && key->kind == Interpolation::Smooth);
}

void TimeLineCells::addInterpolations(QMenu& menu, const Row& row)
{
  const SceneItem item = row.item;
  QMenu* const kinds = menu.addMenu(tr("&Between all its keys"));
  kinds->setObjectName("interpolation");
  kinds->setEnabled(!row.keys.empty());
  const QString names[3] = { tr("&Linear"), tr("&Steps"), tr("S&mooth") };
  for (const Interpolation kind : { Interpolation::Linear, Interpolation::Step, Interpolation::Smooth })
  {
    QAction* const action = kinds->addAction(names[static_cast<int>(kind)], this,
      [this, item, kind]
      { this->edit("Change interpolation", [&](SceneDescription& scene) { setInterpolation(scene, item, kind); }); });
    action->setCheckable(true);
    action->setChecked(interpolationOf(this->State.scene(), item) == kind);
  }
}

void TimeLineCells::addSequences(QMenu& menu, const Row& row)
{
  if (!row.bar)
  {
    return;
  }
  const SceneDescription& scene = this->State.scene();
  const SceneItem item = row.item;
  const ModelLibrary& models = this->State.document().models();
  QMenu* const sequences = menu.addMenu(tr("&Sequence"));
  sequences->setObjectName("sequence");
  const auto change = [this, item](const char* text, const std::function<void(AnimationDescription&)>& act)
  {
    this->State.attempt(
      [&]
      {
        this->State.document().editItem(
          text, item, [&](SceneDescription& edited) { act(edited.objects[item.index].animation); });
      });
  };
  const int current = currentSequence(scene, scene.objects[item.index], models);
  int index = 0;
  for (const std::string& name : sequencesOf(scene, scene.objects[item.index], models))
  {
    QAction* const action = sequences->addAction(menuText(toText(name)), this,
      [change, name] { change("Choose sequence", [&](AnimationDescription& a) { a.sequence = name; }); });
    action->setCheckable(true);
    action->setChecked(index++ == current);
  }
  QAction* const begin = menu.addAction(tr("Be&gin the sequence here"), this,
    [this, change]
    {
      const int frame = this->State.frame();
      change("Move sequence", [frame](AnimationDescription& a) { a.start = frame; });
    });
  begin->setObjectName("beginSequence");
  QAction* const own = menu.addAction(tr("The model's &own speed"), this,
    [change] { change("Change speed of sequence", [](AnimationDescription& a) { a.rate = 1; }); });
  own->setObjectName("ownSpeed");
  QAction* const loop = menu.addAction(tr("Repea&t the sequence"), this,
    [change] { change("Repeat sequence", [](AnimationDescription& a) { a.loop = !a.loop; }); });
  loop->setObjectName("repeatSequence");
  loop->setCheckable(true);
  loop->setChecked(row.bar->loop);
}

void TimeLineCells::shiftKeys(int direction, bool scene, bool copy)
{
  const Row* const row = this->selectedRow();
  const std::vector<int>& keys = scene || row == nullptr ? this->Keys : row->keys;
  Drag drag;
  drag.from.part = scene || row == nullptr ? Part::SceneKey : Part::Key;
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
  drag.from.row = row == nullptr ? std::nullopt : std::make_optional(std::size_t(row - this->Rows.data()));
  this->dragKeys(drag);
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
  this->changeBar(row->item, bar, start);
}

void TimeLineCells::selectRow(int direction)
{
  const Row* const row = this->selectedRow();
  const std::ptrdiff_t last = std::ptrdiff_t(this->Rows.size()) - 1;
  const std::ptrdiff_t next = row == nullptr ? 0 : (row - this->Rows.data()) + direction;
  if (next >= 0 && next <= last)
  {
    this->State.select({ this->Rows[std::size_t(next)].item });
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
      event->modifiers() & Qt::ShiftModifier ? this->removeKey() : this->makeKey();
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
