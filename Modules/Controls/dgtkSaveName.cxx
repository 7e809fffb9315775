// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSaveName.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QRegularExpression>
#include <QStringList>

#include <algorithm>

namespace dgtk
{

namespace
{
/// With their points.
QStringList endingsOf(const QString& filters)
{
  static const QRegularExpression pattern("\\*(\\.\\w+)");
  QStringList endings;
  for (auto at = pattern.globalMatch(filters); at.hasNext();)
  {
    endings << at.next().captured(1);
  }
  return endings;
}

bool endsWithOne(const QString& path, const QStringList& endings)
{
  return std::any_of(endings.begin(), endings.end(),
    [&path](const QString& ending) { return path.endsWith(ending, Qt::CaseInsensitive); });
}

bool mayReplace(QWidget* parent, const QString& path)
{
  QMessageBox box(QMessageBox::Question, QObject::tr("DGTk"),
    QObject::tr("%1 is there already. Replace it?").arg(QFileInfo(path).fileName()), QMessageBox::Yes | QMessageBox::No,
    parent);
  box.setObjectName("replaceBox");
  box.setDefaultButton(QMessageBox::No);
  return box.exec() == QMessageBox::Yes;
}
} // namespace

QString askSaveName(QWidget* parent, const QString& title, const QString& start, const QString& filters)
{
  QFileDialog dialog(parent, title, start, filters);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  // The dialog would ask about the name without its ending.
  dialog.setOption(QFileDialog::DontConfirmOverwrite);
  for (const QString& filter : filters.split(";;"))
  {
    if (endsWithOne(start, endingsOf(filter)))
    {
      dialog.selectNameFilter(filter);
    }
  }
  while (dialog.exec() == QDialog::Accepted)
  {
    QString path = dialog.selectedFiles().value(0);
    if (!endsWithOne(path, endingsOf(filters)))
    {
      path += endingsOf(dialog.selectedNameFilter()).value(0);
    }
    if (!QFileInfo::exists(path) || mayReplace(parent, path))
    {
      return path;
    }
  }
  return {};
}

} // namespace dgtk
