// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAutosave.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QStandardPaths>
#include <QTimer>

#include <cerrno>
#include <csignal>
#include <exception>

namespace dgtk
{

namespace
{
constexpr int interval = 30000; // milliseconds
} // namespace

Autosave::Autosave(EditorState& state)
  : QObject(&state)
  , State(state)
  , Timer(new QTimer(this))
{
  this->Timer->setObjectName("autosave");
  this->Timer->start(interval);
  connect(this->Timer, &QTimer::timeout, this, &Autosave::save);
  connect(&state, &EditorState::changed, this,
    [this]
    {
      this->Changed = true;
      if (!this->State.document().modified())
      {
        QFile::remove(file());
      }
    });
}

Autosave::~Autosave() { QFile::remove(file()); }

QString Autosave::folder() { return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/unsaved"; }

QString Autosave::file() { return folder() + '/' + QString::number(QCoreApplication::applicationPid()) + ".json"; }

QStringList Autosave::leftBehind()
{
  QStringList paths;
  for (const QFileInfo& copy : QDir(folder()).entryInfoList({ "*.json" }, QDir::Files, QDir::Time))
  {
    bool isNumber = false;
    const qlonglong process = copy.completeBaseName().toLongLong(&isNumber);
    if (isNumber && process > 0 && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH)
    {
      paths << copy.absoluteFilePath();
    }
  }
  return paths;
}

void Autosave::save()
{
  if (!this->Changed || !this->State.document().modified())
  {
    return;
  }
  try
  {
    QDir().mkpath(folder());
    this->State.document().writeCopy(file().toStdString());
    this->Changed = false;
  }
  catch (const std::exception&)
  {
    // A full disk shows itself at Save; work goes on.
  }
}

} // namespace dgtk
