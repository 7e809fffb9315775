// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAutosave.h"

#include <QDir>
#include <QFile>
#include <QStandardPaths>
#include <QTimer>
#include <QUuid>

#include <exception>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr int interval = 30000; // milliseconds

QString lockFile(const QString& copy) { return copy + ".lock"; }
} // namespace

/// An exclusive lock of the file beside a copy, which is made for it.
class Autosave::Lock
{
public:
  explicit Lock(const QString& copy)
    : File(::open(QFile::encodeName(lockFile(copy)).constData(), O_RDWR | O_CREAT | O_CLOEXEC, 0600))
    , Got(File >= 0 && ::flock(File, LOCK_EX | LOCK_NB) == 0)
  {
  }
  ~Lock()
  {
    if (this->File >= 0)
    {
      ::close(this->File);
    }
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  bool got() const { return this->Got; }
  /// The scene file whose unsaved work the copy is.
  void keepOrigin(const QString& path) const
  {
    const QByteArray text = path.toUtf8();
    // Without it the recovered scene has no name.
    [[maybe_unused]] const bool kept = this->Got && ::ftruncate(this->File, 0) == 0 &&
                                       ::pwrite(this->File, text.constData(), size_t(text.size()), 0) == text.size();
  }

private:
  int File;
  bool Got;
};

Autosave::Autosave(EditorState& state)
  : QObject(&state)
  , State(state)
  , File(folder() + '/' + QUuid::createUuid().toString(QUuid::WithoutBraces) + ".json")
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
        this->forget();
      }
    });
}

Autosave::~Autosave() { this->forget(); }

QString Autosave::folder() { return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/unsaved"; }

void Autosave::forget()
{
  if (this->Held)
  {
    discard(this->File);
    this->Held.reset();
  }
}

void Autosave::discard(const QString& copy)
{
  QFile::remove(copy);
  QFile::remove(lockFile(copy));
}

QString Autosave::originOf(const QString& copy)
{
  QFile file(lockFile(copy));
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

QStringList Autosave::leftBehind()
{
  QStringList paths;
  for (const QFileInfo& copy : QDir(folder()).entryInfoList({ "*.json" }, QDir::Files, QDir::Time))
  {
    if (Lock(copy.absoluteFilePath()).got())
    {
      paths << copy.absoluteFilePath();
    }
  }
  return paths;
}

void Autosave::adopt(const QString& copy)
{
  if (!this->Held)
  {
    this->Held = std::make_unique<Lock>(this->File);
  }
  this->Held->keepOrigin(originOf(copy));
  if (this->Held->got() && QDir().rename(copy, this->File))
  {
    discard(copy);
  }
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
    if (!this->Held)
    {
      this->Held = std::make_unique<Lock>(this->File);
    }
    this->Held->keepOrigin(toText(this->State.document().path()));
    this->State.document().writeCopy(QFile::encodeName(this->File).toStdString());
    this->Changed = false;
  }
  catch (const std::exception&)
  {
    // A full disk shows itself at Save; work goes on.
  }
}

} // namespace dgtk
