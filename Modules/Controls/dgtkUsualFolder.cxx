// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkUsualFolder.h"

#include <QDir>
#include <QFileInfo>
#include <QMimeData>
#include <QSettings>
#include <QUrl>

namespace dgtk
{

QString usualFolder(const QString& kind)
{
  const QString folder = QSettings().value("folder/" + kind).toString();
  return QFileInfo(folder).isDir() ? folder : QString();
}

void rememberFolder(const QString& chosen, const QString& kind)
{
  const QFileInfo file(chosen);
  QSettings().setValue("folder/" + kind, file.isDir() ? file.absoluteFilePath() : file.absolutePath());
}

QStringList localFiles(const QMimeData& dragged)
{
  QStringList paths;
  for (const QUrl& url : dragged.urls())
  {
    if (url.isLocalFile())
    {
      paths << url.toLocalFile();
    }
  }
  return paths;
}

QStringList foreignAddresses(const QMimeData& dragged)
{
  QStringList addresses;
  for (const QUrl& url : dragged.urls())
  {
    if (!url.isLocalFile())
    {
      addresses << url.toString(QUrl::RemoveUserInfo);
    }
  }
  return addresses;
}

} // namespace dgtk
