// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTruthPanel.h"

#include "dgtkEditorLanguage.h"
#include "dgtkEditorState.h"
#include "dgtkPixelValues.h"
#include "dgtkText.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>

#include <cmath>

namespace dgtk
{

namespace
{
constexpr int mostInALine = 14; // letters of a name and its unit

/// What the panel says in words of its own, or with the values that it belongs to.
bool isSaid(Meaning meaning)
{
  return meaning == Meaning::Class || meaning == Meaning::Index || meaning == Meaning::Visibility;
}

/// The visibility in the other image, which has the value's name and a word more.
const PixelValue* visibilityOf(const PixelValue& value, const std::vector<PixelValue>& all)
{
  for (const PixelValue& other : all)
  {
    const std::size_t stem = other.name.rfind('_');
    if (other.spec.meaning == Meaning::Visibility && other.name.compare(0, stem, value.name) == 0)
    {
      return &other;
    }
  }
  return nullptr;
}
} // namespace

QString exactText(double value)
{
  if (std::isnan(value))
  {
    return QStringLiteral("-");
  }
  return QString::fromStdString(shortest(value));
}

QString exactText(const PixelValue& value, const QString& separator)
{
  QStringList parts;
  bool known = false;
  for (const double one : value.values)
  {
    parts << exactText(one);
    known = known || !std::isnan(one);
  }
  return known ? parts.join(separator) : QStringLiteral("-");
}

QString layerText(const std::string& layer) { return layer == draftLayer ? TruthPanel::tr("Picture") : toText(layer); }

TruthPanel::TruthPanel(QWidget* parent)
  : QTreeWidget(parent)
{
  this->setObjectName("truthPanel");
  this->setColumnCount(2);
  this->setHeaderLabels({ tr("What"), tr("Value") });
  this->setRootIsDecorated(false);
  this->setAlternatingRowColors(true);
  this->setSelectionMode(ExtendedSelection);
  this->header()->setStretchLastSection(false);
  this->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  this->header()->setSectionResizeMode(1, QHeaderView::Stretch);
  this->forgetTruth();
}

void TruthPanel::setRow(const QString& name, const QString& value, const QString& tip)
{
  if (this->Next >= this->topLevelItemCount())
  {
    this->addTopLevelItem(new QTreeWidgetItem);
  }
  QTreeWidgetItem* const row = this->topLevelItem(this->Next++);
  row->setFirstColumnSpanned(false);
  row->setText(0, name);
  row->setText(1, value);
  row->setToolTip(0, tip);
  row->setToolTip(1, value);
  row->setTextAlignment(0, Qt::AlignLeft | Qt::AlignTop);
  row->setTextAlignment(1, Qt::AlignLeft | Qt::AlignTop);
}

void TruthPanel::finishRows()
{
  while (this->topLevelItemCount() > this->Next)
  {
    delete this->takeTopLevelItem(this->topLevelItemCount() - 1);
  }
}

void TruthPanel::forgetTruth()
{
  this->Next = 0;
  this->HasTruth = false;
  const QString hint = tr("Move the mouse over the perspective view.");
  this->setRow(hint, {}, hint);
  this->topLevelItem(0)->setFirstColumnSpanned(true);
  this->finishRows();
}

void TruthPanel::showTruth(const QString& view, const PixelTruth& truth, const QString& units)
{
  this->Next = 0;
  this->HasTruth = true;
  this->setRow(tr("View"), tr("%1, frame %2").arg(view, QString::number(truth.frame)));
  this->setRow(tr("Pixel"), tr("column %1, row %2").arg(truth.column).arg(truth.row));
  if (!truth.message.empty())
  {
    this->setRow(tr("Unknown"), messageText(truth.message));
    this->finishRows();
    return;
  }
  this->setRow(tr("Object"),
    truth.object.empty() ? tr("nothing") : tr("%1 (id %2)").arg(toText(truth.object), QString::number(truth.id)));
  if (!truth.object.empty())
  {
    if (!truth.className.empty())
    {
      this->setRow(tr("Class"), toText(truth.className));
    }
    this->setRow(tr("Part"),
      tr("%1 (id %2)").arg(truth.part.empty() ? tr("unnamed") : toText(truth.part), QString::number(truth.partId)));
    this->setRow(tr("Triangle"), QString::number(truth.triangle));
    this->showValues(truth, units);
  }
  this->setRow(tr("Surfaces"), QString::number(truth.layers.size()));
  int rank = 1;
  for (const PixelLayer& layer : truth.layers)
  {
    this->setRow(tr("  %1: %2").arg(rank++).arg(toText(layer.object)),
      (truth.isLinear ? tr("depth %1\npart %2, triangle %3") : tr("distance %1\npart %2, triangle %3"))
        .arg(exactText(layer.depth))
        .arg(layer.part)
        .arg(layer.triangle));
  }
  this->finishRows();
}

void TruthPanel::showValues(const PixelTruth& truth, const QString& units)
{
  for (const PixelValue& value : truth.values)
  {
    const QString name = toText(value.spec.name);
    const bool coverage = value.spec.meaning == Meaning::Id && value.values.size() == 4;
    if (isSaid(value.spec.meaning) || (value.spec.meaning == Meaning::Id && !coverage))
    {
      continue;
    }
    QString own = toText(value.spec.unit);
    const QString unit =
      units.isEmpty() ? unitText(value.spec.unit) : unitText(own.replace("scene units", units).toStdString());
    const QString numbers = exactText(value, QStringLiteral("\n"));
    const bool bare = unit == "1" || unit == "id" || numbers == "-";
    QString text = numbers;
    // What the image is of beyond its layer, another camera, has its own name.
    const QString of = toText(value.name).mid(name.size() + 1);
    const QString what = QString(name).replace('_', ' ') + (of.isEmpty() ? of : ' ' + of);
    const PixelValue* const seen = visibilityOf(value, truth.values);
    if (numbers != "-" && seen != nullptr)
    {
      text += '\n' + visibilityText(static_cast<std::uint32_t>(seen->values.front()));
    }
    if (coverage)
    {
      const std::vector<double>& v = value.values;
      text = tr("id %1, coverage %2 / 255").arg(idOf(v.data(), v.size())).arg(v[3]);
    }
    const QString separator = what.size() + unit.size() > mostInALine ? QStringLiteral(",\n") : QStringLiteral(", ");
    this->setRow(bare ? what : what + separator + unit, text, toText(value.spec.description));
  }
}

QString TruthPanel::text() const
{
  QStringList lines;
  for (int i = 0; i < this->topLevelItemCount() && this->HasTruth; ++i)
  {
    const QTreeWidgetItem* const row = this->topLevelItem(i);
    lines << row->text(0).replace(",\n", ", ") + '\t' + row->text(1).replace('\n', '\t');
  }
  return lines.join('\n');
}

bool TruthPanel::event(QEvent* event)
{
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy))
  {
    event->accept(); // or the window copies what is selected in the scene
    return true;
  }
  return QTreeWidget::event(event);
}

void TruthPanel::keyPressEvent(QKeyEvent* event)
{
  if (event->matches(QKeySequence::Copy))
  {
    if (this->HasTruth)
    {
      QApplication::clipboard()->setText(this->text());
    }
    return;
  }
  QTreeWidget::keyPressEvent(event);
}

} // namespace dgtk
