// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneViews.h"

#include "dgtkViewLines.h"

#include <QLabel>
#include <QSettings>
#include <QSplitter>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <exception>

namespace dgtk
{

namespace
{
constexpr int titleHeight = 24; // pixels
}

SceneViews::SceneViews(EditorState& state, QWidget* parent)
  : QWidget(parent)
  , State(state)
  , Tool(new HandleTool(state, this))
{
  const QString titles[4] = { tr("Front"), tr("Top"), tr("Side"), tr("Perspective") };
  this->Columns = new QSplitter(Qt::Vertical, this);
  for (QSplitter*& row : this->Rows)
  {
    row = new QSplitter(Qt::Horizontal, this->Columns);
    row->setChildrenCollapsible(false);
  }
  this->Columns->setChildrenCollapsible(false);
  for (int kind = 0; kind < 4; ++kind)
  {
    QWidget* const pane = this->makePane(static_cast<ViewKind>(kind), titles[kind]);
    this->Rows[kind / 2]->addWidget(pane);
    this->Panes.push_back(pane);
  }
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Columns);
  this->activate(this->view(ViewKind::Perspective));
  connect(this->Tool, &HandleTool::told, this, &SceneViews::told);
  connect(&state, &EditorState::changed, this, &SceneViews::refresh);
  connect(&state, &EditorState::selectionChanged, this, &SceneViews::showSelection);
  connect(&state, &EditorState::frameChanged, this, &SceneViews::refresh);
  this->refresh();
}

SceneViews::~SceneViews() = default;

QWidget* SceneViews::makePane(ViewKind kind, const QString& title)
{
  auto* pane = new QWidget;
  auto* layout = new QVBoxLayout(pane);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  auto* label = new QLabel(title, pane);
  auto* bar = new QHBoxLayout;
  bar->setContentsMargins(6, 1, 2, 1);
  bar->addWidget(label);
  bar->addStrut(titleHeight);
  layout->addLayout(bar);
  this->Titles.push_back(bar);
  auto* view = new SceneView(kind, pane);
  view->setObjectName("view." + QString::number(static_cast<int>(kind)));
  layout->addWidget(view, 1);
  this->Views.push_back(view);
  connect(view, &SceneView::activated, this, [this, view] { this->activate(view); });
  connect(view, &SceneView::picked, this, &SceneViews::pick);
  this->connectDrags(view);
  connect(view, &SceneView::maximizeAsked, this, [this, view] { this->toggleMaximized(view); });
  connect(view, &SceneView::menuAsked, this, &SceneViews::menuAsked);
  return pane;
}

void SceneViews::refresh()
{
  const SceneDescription& scene = this->State.scene();
  try
  {
    this->Places =
      std::make_shared<ScenePlaces>(placeScene(scene, this->State.document().models(), this->State.frame()));
  }
  catch (const std::exception& error)
  {
    emit this->failed(QString::fromUtf8(error.what()));
    return;
  }
  const std::shared_ptr<const EnvironmentLight> environment = environmentLight(this->Places->surroundings->environment);
  for (SceneView* view : this->Views)
  {
    view->showScene(scene, this->Places, environment, this->Meshes);
  }
  this->takeUpAxis();
  this->showSelection();
  this->Meshes.forgetUnused();
}

void SceneViews::takeUpAxis()
{
  const std::size_t opened = this->State.document().opened();
  if (this->State.scene().upAxis != this->Up || opened != this->Opened)
  {
    this->Up = this->State.scene().upAxis;
    this->Opened = opened;
    for (SceneView* view : this->Views)
    {
      view->resetCamera(this->Up);
    }
    this->frameObjects();
  }
}

void SceneViews::showWhole()
{
  this->WholeWanted = !this->isVisible();
  this->frameObjects();
}

void SceneViews::showEvent(QShowEvent*)
{
  if (this->WholeWanted)
  {
    // After the layout has given the views their sizes.
    QTimer::singleShot(0, this, &SceneViews::showWhole);
  }
}

void SceneViews::activate(SceneView* view)
{
  this->Active = view;
  for (SceneView* other : this->Views)
  {
    other->setActive(other == view);
  }
}

void SceneViews::frameAll()
{
  for (SceneView* view : this->Views)
  {
    view->frame(this->Places->box);
  }
}

void SceneViews::frameObjects()
{
  // Cameras and lights may stand far off: objects count where there are any.
  WorldBox box;
  for (const ObjectPlace& object : this->Places->objects)
  {
    if (object.visible)
    {
      box.add(object.box);
    }
  }
  for (SceneView* view : this->Views)
  {
    view->frame(box.empty() ? this->Places->box : box);
  }
}

void SceneViews::frameSelected()
{
  WorldBox box;
  for (const SceneItem& item : this->State.selection())
  {
    box.add(drawnBox(*this->Places, item));
  }
  if (!box.empty())
  {
    for (SceneView* view : this->Views)
    {
      view->frame(box);
    }
  }
}

void SceneViews::setStyle(ViewStyle style)
{
  for (SceneView* view : this->Views)
  {
    view->setStyle(style);
  }
  this->refresh();
}

void SceneViews::setSceneLights(bool on)
{
  for (SceneView* view : this->Views)
  {
    view->setSceneLights(on);
  }
  this->refresh();
}

void SceneViews::showGrid(bool on)
{
  for (SceneView* view : this->Views)
  {
    view->showGrid(on);
  }
}

bool SceneViews::isAlone(const SceneView* view) const
{
  bool alone = true;
  for (std::size_t i = 0; i < this->Views.size(); ++i)
  {
    alone = alone && (this->Views[i] == view || this->Panes[i]->isHidden());
  }
  return alone;
}

QByteArrayList SceneViews::splitters() const
{
  return { this->Columns->saveState(), this->Rows[0]->saveState(), this->Rows[1]->saveState() };
}

void SceneViews::restoreSplitters(const QByteArrayList& states)
{
  if (states.size() == 3)
  {
    this->Columns->restoreState(states[0]);
    this->Rows[0]->restoreState(states[1]);
    this->Rows[1]->restoreState(states[2]);
  }
}

void SceneViews::toggleMaximized(SceneView* view)
{
  const bool all = this->isAlone(view);
  if (std::none_of(this->Panes.begin(), this->Panes.end(), [](const QWidget* pane) { return pane->isHidden(); }))
  {
    this->Divided = this->splitters();
  }
  for (std::size_t i = 0; i < this->Views.size(); ++i)
  {
    this->Panes[i]->setVisible(all || this->Views[i] == view);
  }
  for (int row = 0; row < 2; ++row)
  {
    const auto first = std::size_t(2 * row);
    this->Rows[row]->setVisible(all || this->Views[first] == view || this->Views[first + 1] == view);
  }
  if (all)
  {
    this->restoreSplitters(this->Divided);
  }
}

void SceneViews::saveLayout(QSettings& settings) const
{
  int alone = -1;
  for (std::size_t i = 0; i < this->Views.size(); ++i)
  {
    alone = this->isAlone(this->Views[i]) ? static_cast<int>(i) : alone;
  }
  settings.setValue("views/alone", alone);
  const QByteArrayList states = alone < 0 ? this->splitters() : this->Divided;
  for (int i = 0; i < states.size(); ++i)
  {
    settings.setValue("views/splitter" + QString::number(i), states[i]);
  }
}

void SceneViews::resetLayout()
{
  for (SceneView* view : this->Views)
  {
    if (this->isAlone(view))
    {
      this->toggleMaximized(view);
      break;
    }
  }
  for (QSplitter* splitter : this->findChildren<QSplitter*>())
  {
    splitter->setSizes({ 1000, 1000 });
  }
}

void SceneViews::restoreLayout(const QSettings& settings)
{
  QByteArrayList states;
  for (int i = 0; i < 3; ++i)
  {
    states << settings.value("views/splitter" + QString::number(i)).toByteArray();
  }
  this->restoreSplitters(states);
  const int alone = settings.value("views/alone", -1).toInt();
  if (alone >= 0 && alone < static_cast<int>(this->Views.size()))
  {
    SceneView* const view = this->Views[std::size_t(alone)];
    this->toggleMaximized(view);
    this->Divided = states;
    view->setFocus();
    this->activate(view);
  }
}

void SceneViews::lookThrough(const CameraDescription& camera)
{
  if (this->view(ViewKind::Perspective)->lookThrough(camera, this->State.frame()))
  {
    this->activate(this->view(ViewKind::Perspective));
    emit this->lookedThrough(camera);
  }
  else
  {
    emit this->failed(
      tr("%1 looks at its own place at this frame: move its look-at point").arg(QString::fromStdString(camera.name)));
  }
}

void SceneViews::pick(bool hit, int kind, int index, bool add)
{
  if (!hit)
  {
    if (!add)
    {
      this->State.select({});
    }
    return;
  }
  const SceneItem item{ static_cast<SceneItem::Kind>(kind), static_cast<std::size_t>(index) };
  if (add)
  {
    this->State.toggle(item);
  }
  else
  {
    this->State.select({ item });
  }
}

void SceneViews::setHurried(bool on)
{
  for (SceneView* view : this->Views)
  {
    view->setHurried(on);
  }
}

void SceneViews::connectDrags(SceneView* view)
{
  const auto show = [this, view]
  {
    if (this->Tool->active())
    {
      view->showDrag(this->Tool->handle(), this->Tool->text());
    }
  };
  connect(view, &SceneView::dragStarted, this,
    [this, view]
    {
      this->setHurried(true);
      this->Tool->start(*view, *this->Places);
    });
  connect(view, &SceneView::dragged, this,
    [this, show](const QPointF& pixel, bool snap)
    {
      this->Tool->drag(pixel, snap);
      show();
    });
  connect(view, &SceneView::constrained, this,
    [this, show](int axis, bool plane)
    {
      this->Tool->constrain(axis, plane);
      show();
    });
  connect(view, &SceneView::dragFinished, this,
    [this]
    {
      this->Tool->finish();
      this->setHurried(false);
      this->showHandles();
    });
  connect(view, &SceneView::dragCancelled, this,
    [this]
    {
      this->Tool->cancel();
      this->setHurried(false);
      this->showHandles();
    });
}

void SceneViews::setHandleMode(HandleMode mode)
{
  this->Tool->setMode(mode);
  this->showHandles();
}

void SceneViews::setHandlePivot(HandlePivot pivot)
{
  this->Tool->setPivot(pivot);
  this->showHandles();
}

void SceneViews::showSelection()
{
  for (SceneView* view : this->Views)
  {
    view->showSelected(this->State.selection());
  }
  this->showHandles();
}

void SceneViews::showHandles()
{
  const std::optional<HandlePlace> place = this->Tool->place(*this->Places);
  for (SceneView* view : this->Views)
  {
    view->showHandles(place);
  }
}

} // namespace dgtk
