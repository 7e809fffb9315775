// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDraftLabel.h"

#include <QCoreApplication>
#include <QLabel>

namespace dgtk
{

namespace
{
constexpr int margin = 6; // pixels
}

QLabel* makeDraftLabel(QWidget* picture)
{
  auto* label = new QLabel(QCoreApplication::translate("dgtk::DraftLabel", "Draft"), picture);
  label->setObjectName("draft");
  label->setAttribute(Qt::WA_TransparentForMouseEvents);
  label->setStyleSheet("color: white; background: rgba(0, 0, 0, 150); padding: 1px 5px");
  label->move(margin, margin);
  label->adjustSize();
  return label;
}

} // namespace dgtk
