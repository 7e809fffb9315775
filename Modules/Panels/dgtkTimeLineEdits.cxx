// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineEdits.h"

#include "dgtkNamedAction.h"

#include <QMenu>

namespace dgtk
{

using namespace timeline;

TimeLineEdits::TimeLineEdits(EditorState& state, QObject* parent)
  : QObject(parent)
  , State(state)
{
}

void TimeLineEdits::edit(const QString& text, const std::function<void(SceneDescription&)>& change)
{
  this->State.attempt([&] { this->State.document().edit(text.toStdString(), change); });
}

void TimeLineEdits::makeKey()
{
  const int frame = this->State.frame();
  this->edit("Make key frame", [frame](SceneDescription& scene) { makeKeyFrame(scene, frame); });
}

void TimeLineEdits::removeKey()
{
  const int frame = this->State.frame();
  this->edit("Remove key frame", [frame](SceneDescription& scene) { removeKeyFrame(scene, frame); });
}

void TimeLineEdits::pasteKey(int from, bool move)
{
  const int to = this->State.frame();
  this->edit(move ? "Move key frame" : "Paste key frame",
    [&](SceneDescription& scene) { move ? moveKeyFrame(scene, from, to) : copyKeyFrame(scene, from, to); });
}

void TimeLineEdits::dragKeys(const Drag& drag, SceneItem item)
{
  const int from = drag.from.frame;
  const int to = drag.to;
  const bool copy = drag.copy;
  if (drag.from.target == Target::SceneKey)
  {
    this->edit(copy ? "Copy key frame" : "Move key frame",
      [&](SceneDescription& scene) { copy ? copyKeyFrame(scene, from, to) : moveKeyFrame(scene, from, to); });
  }
  else
  {
    this->edit(copy ? "Copy keys" : "Move keys", [&](SceneDescription& scene)
      { copy ? copyItemKeys(scene, item, from, to) : moveItemKeys(scene, item, from, to); });
  }
  this->State.setFrame(to);
}

void TimeLineEdits::changeBar(SceneItem item, const SequenceBar& bar, bool start)
{
  const ModelLibrary& models = this->State.document().models();
  this->State.attempt(
    [&]
    {
      this->State.document().editItem(start ? "Move sequence" : "Change speed of sequence", item,
        [&](SceneDescription& scene)
        {
          ObjectDescription& object = scene.objects[item.index];
          if (start)
          {
            object.animation.start = bar.start;
          }
          else
          {
            setSequenceLength(scene, object, models, bar.length);
          }
        });
    });
}

void TimeLineEdits::addActions(QMenu& menu, const Row& row)
{
  this->addKeyActions(menu, row);
  this->addInterpolations(menu, row);
  this->addSequences(menu, row);
}

void TimeLineEdits::addKeyActions(QMenu& menu, const Row& row)
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

void TimeLineEdits::addInterpolations(QMenu& menu, const Row& row)
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

void TimeLineEdits::addSequences(QMenu& menu, const Row& row)
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

} // namespace dgtk
