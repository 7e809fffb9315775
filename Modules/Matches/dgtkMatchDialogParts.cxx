// SPDX-License-Identifier: BSD-3-Clause
// What the dialog is made of, and what it says about the point that is looked at.
#include "dgtkMatchDialog.h"

#include "dgtkDraftLabel.h"
#include "dgtkEditorIcons.h"
#include "dgtkEditorLanguage.h"
#include "dgtkMatchPane.h"
#include "dgtkNumberBox.h"
#include "dgtkTruthPanel.h"
#include "dgtkWindowSize.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int buttonRoom = 16; // pixels beside a button's text, at least
constexpr int besideSide = 12; // pixels between the numbers of a view and the words of the next
const QColor pickedColor(255, 214, 64);
const QColor lineColor(64, 200, 255);
const QColor pairColor(235, 235, 235);

QColor colorOf(VisibilityClass visibility)
{
  switch (visibility)
  {
    case VisibilityClass::Visible:
      return { 90, 230, 90 };
    case VisibilityClass::OccludedByOther:
    case VisibilityClass::OccludedByOwn:
      return { 255, 140, 40 };
    default:
      return { 255, 70, 70 };
  }
}

QPointF pointOf(const Eigen::Vector2d& pixel) { return { pixel.x(), pixel.y() }; }
} // namespace

MatchDialog::MatchDialog(EditorState& state, QWidget* parent)
  : QDialog(parent)
  , State(state)
{
  this->setObjectName("matchDialog");
  this->setWindowTitle(tr("Correspondence"));
  this->setWindowFlag(Qt::WindowMaximizeButtonHint);
  auto* layout = new QVBoxLayout(this);
  auto* views = new QSplitter(Qt::Horizontal);
  views->setChildrenCollapsible(false);
  views->addWidget(this->makeSide(0));
  views->addWidget(this->makeSide(1));
  views->setStretchFactor(0, 1);
  views->setStretchFactor(1, 1);
  views->setSizes({ 1000, 1000 });
  auto* lower = new QWidget;
  auto* below = new QHBoxLayout(lower);
  below->setContentsMargins(0, 0, 0, 0);
  below->addWidget(this->makeNumbers(), 1);
  below->addWidget(this->makePairs(), 1);
  auto* rows = new QSplitter(Qt::Vertical);
  rows->setChildrenCollapsible(false);
  rows->addWidget(views);
  rows->addWidget(lower);
  rows->setStretchFactor(0, 1);
  this->makeControls(layout);
  layout->addWidget(rows, 1);
  resizeWithin(*this, 1180, 800);
  this->Opened = state.document().opened();
  connect(&state, &EditorState::changed, this,
    [this]
    {
      this->Changed = true;
      if (const std::size_t opened = this->State.document().opened(); opened != this->Opened)
      {
        this->Scene.reset(); // its models are nobody's any more
        this->Table->forgetAll();
        this->Opened = opened;
      }
      this->refresh();
    });
}

QWidget* MatchDialog::makeSide(std::size_t index)
{
  Side& side = this->Sides[index];
  const QString suffix = QStringLiteral(".%1").arg(index);
  auto* widget = new QWidget;
  auto* layout = new QVBoxLayout(widget);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* row = new QHBoxLayout;
  side.camera = new QComboBox;
  side.camera->setObjectName("camera" + suffix);
  side.camera->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  side.frame = new NumberBox<QSpinBox>;
  side.frame->setObjectName("frame" + suffix);
  side.where = new QLabel;
  side.where->setObjectName("where" + suffix);
  side.pane = new MatchPane(widget);
  makeDraftLabel(side.pane);
  side.pane->setObjectName("pane" + suffix);
  side.truth = std::make_unique<LiveTruth>();
  tellIn(*side.frame, *side.where);
  auto* camera = new QLabel(index == 0 ? tr("&Left camera") : tr("&Right camera"));
  camera->setBuddy(side.camera);
  row->addWidget(camera);
  row->addWidget(side.camera);
  row->addWidget(new QLabel(tr("Frame")));
  row->addWidget(side.frame);
  row->addWidget(side.where, 1);
  row->setContentsMargins(0, 0, besideSide, 0);
  layout->addLayout(row);
  layout->addWidget(side.pane, 1);
  const auto show = [this, index] { this->showView(index); };
  connect(side.camera, QOverload<int>::of(&QComboBox::currentIndexChanged), this, show);
  connect(side.frame, QOverload<int>::of(&QSpinBox::valueChanged), this, show);
  connect(side.pane, &MatchPane::picked, this, [this, index](double x, double y) { this->pick(index, { x, y }); });
  connect(side.pane, &MatchPane::moved, this, [this, index](double dx, double dy) { this->move(index, { dx, dy }); });
  side.where->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  connect(side.pane, &MatchPane::pointed, this,
    [where = side.where](bool inside, double x, double y)
    { where->setText(inside ? tr("x %1  y %2").arg(x, 0, 'f', 2).arg(y, 0, 'f', 2) : QString()); });
  return widget;
}

void MatchDialog::makeControls(QVBoxLayout* layout)
{
  auto* row = new QHBoxLayout;
  this->Layer = new QComboBox;
  this->Layer->setObjectName("layer");
  for (const LiveLayer& layer : liveLayers())
  {
    this->Layer->addItem(layerText(layer.name), toText(layer.name));
    this->Layer->setItemData(this->Layer->count() - 1, toText(layer.description), Qt::ToolTipRole);
  }
  auto* label = new QLabel(tr("&Show"));
  label->setBuddy(this->Layer);
  this->Centers = new QCheckBox(tr("&Pixel centres only"));
  this->Centers->setObjectName("centers");
  this->Centers->setChecked(true);
  this->Centers->setToolTip(tr("A click takes the centre of its pixel, as the dense layers of a dataset do"));
  auto* swap = new QPushButton(tr("S&wap"));
  swap->setObjectName("swap");
  swap->setAutoDefault(false);
  row->addWidget(label);
  row->addWidget(this->Layer);
  row->addSpacing(12);
  row->addWidget(this->Centers);
  row->addSpacing(12);
  row->addWidget(swap);
  row->addStretch(1);
  layout->addLayout(row);
  connect(this->Layer, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this]
    {
      this->askPicture(0);
      this->askPicture(1);
    });
  connect(swap, &QPushButton::clicked, this, &MatchDialog::swapSides);
}

QLabel* MatchDialog::addNumber(QFormLayout* form, const QString& label, const char* name)
{
  auto* value = new QLabel;
  value->setTextFormat(Qt::PlainText);
  value->setObjectName(name);
  value->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  value->setWordWrap(true);
  form->addRow(label, value);
  return value;
}

QWidget* MatchDialog::makeNumbers()
{
  auto* widget = new QWidget;
  auto* form = new QFormLayout(widget);
  form->setContentsMargins(0, 6, 6, 0);
  form->setVerticalSpacing(3);
  this->addNumber(form, tr("Point"), "match.from");
  this->addNumber(form, tr("Its match"), "match.to");
  this->addNumber(form, tr("Visibility there"), "match.class");
  this->addNumber(form, tr("Surface"), "match.surface");
  this->addNumber(form, tr("Depth"), "match.depthFrom");
  this->addNumber(form, tr("Depth there"), "match.depthTo");
  this->addNumber(form, tr("World"), "match.worldFrom");
  this->addNumber(form, tr("World there"), "match.worldTo");
  this->addNumber(form, tr("Epipolar line"), "match.line");
  this->addNumber(form, tr("Match to line"), "match.distance");
  return widget;
}

QWidget* MatchDialog::makePairs()
{
  auto* widget = new QWidget;
  auto* layout = new QVBoxLayout(widget);
  layout->setContentsMargins(6, 6, 0, 0);
  auto* row = new QHBoxLayout;
  const auto add = [&](const char* name, const QString& text)
  {
    auto* button = new QPushButton(text);
    button->setObjectName(name);
    button->setAutoDefault(false);
    button->setMinimumWidth(button->fontMetrics().horizontalAdvance(text) + buttonRoom);
    row->addWidget(button);
    return button;
  };
  QPushButton* const collect = add("addPair", tr("&Add pair"));
  collect->setShortcut(QKeySequence("Ctrl+Return"));
  collect->setToolTip(tr("Adds the point and its match to the list (Ctrl+Return)"));
  connect(collect, &QPushButton::clicked, this, &MatchDialog::addPair);
  this->Table = new MatchTable(widget);
  connect(add("deletePairs", tr("&Delete")), &QPushButton::clicked, this->Table, &MatchTable::removeSelected);
  connect(add("clearPairs", tr("&Clear")), &QPushButton::clicked, this,
    [this]
    {
      if (this->mayDiscard())
      {
        this->Table->clearAll();
      }
    });
  const auto addTool = [&](const char* name, const char* icon, const QString& text, const QKeySequence& keys)
  {
    auto* action = new QAction(editorIcon(icon), text, this);
    action->setObjectName(name);
    action->setToolTip(tr("%1 (%2)").arg(text, keys.toString(QKeySequence::NativeText)));
    action->setShortcut(keys);
    this->addAction(action);
    auto* button = new QToolButton;
    button->setObjectName(name);
    button->setDefaultAction(action);
    button->setFocusPolicy(Qt::TabFocus);
    row->addWidget(button);
    return action;
  };
  connect(addTool("undoPairs", "undo", tr("Undo"), QKeySequence("Ctrl+Z")), &QAction::triggered, this->Table,
    &MatchTable::undo);
  connect(addTool("redoPairs", "redo", tr("Redo"), QKeySequence("Ctrl+Shift+Z")), &QAction::triggered, this->Table,
    &MatchTable::redo);
  row->addStretch(1);
  connect(add("openPairs", tr("&Open ...")), &QPushButton::clicked, this, &MatchDialog::askOpen);
  connect(add("savePairs", tr("Sa&ve ...")), &QPushButton::clicked, this, &MatchDialog::askSave);
  layout->addLayout(row);
  layout->addWidget(this->Table, 1);
  connect(this->Table, &MatchTable::pairsChanged, this,
    [this]
    {
      this->showMarks();
      this->refreshButtons();
      this->checkPairs();
    });
  connect(this->Table, &QTableWidget::itemSelectionChanged, this, &MatchDialog::refreshButtons);
  connect(this->Table, &QTableWidget::cellClicked, this, [this](int pair) { this->showPair(pair); });
  connect(this->Table, &QTableWidget::cellActivated, this, [this](int pair) { this->showPair(pair); });
  return widget;
}

void MatchDialog::showMatch()
{
  const auto set = [this](const char* name, const QString& text)
  { this->findChild<QLabel*>(name)->setText(text.isEmpty() ? QStringLiteral("-") : text); };
  const auto place = [this](std::size_t side, const Eigen::Vector2d& pixel)
  {
    return tr("%1, frame %2:  %3, %4")
      .arg(this->Sides[side].camera->currentText(), QString::number(this->Sides[side].frame->value()),
        exactText(pixel.x()), exactText(pixel.y()));
  };
  const auto vector = [](const Eigen::Vector3d& v)
  { return exactText(v.x()) + ",  " + exactText(v.y()) + ",  " + exactText(v.z()); };
  for (const char* name : { "match.from", "match.to", "match.surface", "match.class", "match.depthFrom",
         "match.depthTo", "match.worldFrom", "match.worldTo", "match.line", "match.distance" })
  {
    set(name, {});
  }
  if (!this->Active)
  {
    set("match.from", tr("Click a point of either picture."));
  }
  else
  {
    set("match.from", place(this->Active->side, this->Active->pixel));
  }
  if (this->Match)
  {
    const LiveMatch& match = *this->Match;
    const bool surface = match.hit.object != 0;
    set("match.to", match.to.pixel.allFinite() ? place(1 - this->Active->side, match.to.pixel) : QString());
    set("match.surface", !match.message.empty() ? messageText(match.message)
                         : surface
                           ? tr("%1, part %2, triangle %3")
                               .arg(toText(match.object), QString::number(match.part), QString::number(match.triangle))
                           : tr("nothing"));
    QString kind = QString::number(int(match.to.visibility)) + ' ' + visibilityText(std::uint32_t(match.to.visibility));
    set("match.class", match.occluder.empty() ? kind : kind + ": " + toText(match.occluder));
    if (surface)
    {
      set("match.depthFrom", exactText(match.depthFrom));
      set("match.depthTo", exactText(match.depthTo));
      set("match.worldFrom", vector(match.worldFrom));
      set("match.worldTo", vector(match.worldTo));
    }
    if (match.line)
    {
      const auto term = [](double value, const char* name)
      { return (value < 0 ? QStringLiteral(" - ") : QStringLiteral(" + ")) + exactText(std::abs(value)) + name; };
      const Eigen::Vector3d& line = *match.line;
      set("match.line", exactText(line.x()) + " x" + term(line.y(), " y") + term(line.z(), " = 0"));
      set("match.distance", surface ? tr("%1 pixels").arg(exactText(match.lineDistance)) : QString());
    }
    else if (match.message.empty())
    {
      const bool linear = std::all_of(this->Sides.begin(), this->Sides.end(),
        [](const Side& side)
        { return side.view && side.view->view.model->linear() && !side.view->view.model->rolls(); });
      set("match.line", linear ? tr("none: the ray is a point in the other picture, or at infinity")
                               : tr("none: one of the cameras is not linear, or has a rolling shutter"));
    }
  }
  this->showMarks();
  this->refreshButtons();
}

void MatchDialog::showMarks()
{
  std::array<std::vector<MatchPane::Mark>, 2> marks;
  const std::array<SparseView, 2> views{ this->sparseView(0), this->sparseView(1) };
  int number = 0;
  for (const MatchRow& pair : this->Table->pairs())
  {
    ++number;
    for (std::size_t side = 0; side < 2; ++side)
    {
      if (pair.from == views[side] && pair.to == views[1 - side])
      {
        marks[side].push_back({ pointOf(pair.match.from), pairColor, QString::number(number) });
        if (pair.match.to.pixel.allFinite())
        {
          marks[1 - side].push_back({ pointOf(pair.match.to.pixel), pairColor, QString::number(number) });
        }
      }
    }
  }
  std::array<std::optional<Eigen::Vector3d>, 2> lines;
  if (this->Active)
  {
    const std::size_t side = this->Active->side;
    marks[side].push_back({ pointOf(this->Active->pixel), pickedColor, {}, true });
    if (this->Match && this->Match->to.pixel.allFinite())
    {
      const QPointF there = pointOf(this->Match->to.pixel);
      marks[1 - side].push_back({ there, colorOf(this->Match->to.visibility), {}, true });
      this->Sides[1 - side].pane->ensureVisible(there);
    }
    lines[1 - side] = this->Match ? this->Match->line : std::nullopt;
  }
  for (std::size_t side = 0; side < 2; ++side)
  {
    this->Sides[side].pane->setMarks(marks[side]);
    this->Sides[side].pane->setLine(lines[side], lineColor);
  }
}

void MatchDialog::addPair()
{
  if (this->Match && this->Active && this->Match->message.empty())
  {
    const std::size_t side = this->Active->side;
    const MatchRow pair{ this->sparseView(side), this->sparseView(1 - side),
      { this->Match->from, this->Match->to, this->Match->hit }, toText(this->Match->object) };
    const std::vector<MatchRow>& pairs = this->Table->pairs();
    const auto same = std::find_if(pairs.begin(), pairs.end(),
      [&pair](const MatchRow& other)
      { return other.from == pair.from && other.to == pair.to && other.match.from == pair.match.from; });
    if (same != pairs.end())
    {
      const int row = int(same - pairs.begin());
      this->Table->selectRow(row); // it is there already
      if (!this->Table->isMarked(row))
      {
        return;
      }
      this->Table->removeSelected();
    }
    this->Table->add({ pair });
  }
}

} // namespace dgtk
