// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadOut.h"

#include <QHeaderView>
#include <QLabel>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int shownRows = 4; // more are scrolled
} // namespace

ReadOut::ReadOut(QWidget* parent)
  : QWidget(parent)
  , Pixel(new QLabel(this))
  , Table(new QTableWidget(0, 4, this))
{
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  this->Pixel->setObjectName("pixel");
  this->Table->setObjectName("readOut");
  this->Table->setHorizontalHeaderLabels({ tr("Camera"), tr("Layer"), tr("Value"), tr("World point") });
  this->Table->verticalHeader()->hide();
  this->Table->verticalHeader()->setDefaultSectionSize(this->fontMetrics().height() + 6);
  this->Table->horizontalHeader()->setSectionResizeMode(2, QHeaderView::Stretch);
  const QString longest("(-1.23457e-05, -1.23457e-05, -1.23457e-05)");
  this->Table->setColumnWidth(3, this->fontMetrics().horizontalAdvance(longest) + 12);
  this->Table->setTextElideMode(Qt::ElideMiddle);
  this->Table->setTabKeyNavigation(false);
  this->Table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  const int rows = shownRows * this->Table->verticalHeader()->defaultSectionSize();
  this->Table->setFixedHeight(rows + this->Table->horizontalHeader()->sizeHint().height() + 4);
  layout->addWidget(this->Pixel);
  layout->addWidget(this->Table);
}

void ReadOut::showRows(const std::optional<QPoint>& pixel, const std::vector<Row>& rows)
{
  this->Pixel->setText(
    pixel ? tr("Pixel (%1, %2)").arg(pixel->x()).arg(pixel->y()) : tr("Point at a picture to read its numbers."));
  this->Table->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    for (int column = 0; column < this->Table->columnCount(); ++column)
    {
      const QString& cell = rows[std::size_t(row)][std::size_t(column)];
      QTableWidgetItem* item = this->Table->item(row, column);
      if (item == nullptr)
      {
        item = new QTableWidgetItem;
        this->Table->setItem(row, column, item);
      }
      item->setText(cell);
      item->setToolTip(cell);
    }
  }
  this->fitColumns();
}

void ReadOut::fitColumns()
{
  const QAbstractItemView* const view = this->Table; // whose hints are public
  const QHeaderView* const header = this->Table->horizontalHeader();
  for (const int column : { 0, 1 })
  {
    const int whole = std::max(view->sizeHintForColumn(column), header->sectionSizeHint(column));
    this->Table->setColumnWidth(column, std::min(whole, this->Table->width() / 4));
  }
}

QString ReadOut::text() const
{
  QStringList lines{ this->Pixel->text() };
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    QStringList cells;
    for (int column = 0; column < this->Table->columnCount(); ++column)
    {
      cells << this->Table->item(row, column)->text();
    }
    lines << cells.join('\t');
  }
  return lines.join('\n');
}

} // namespace dgtk
