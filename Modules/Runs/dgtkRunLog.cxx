// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunLog.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QThread>

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr int headLines = 2; // request and process
constexpr const char* logName = "run.log";
constexpr const char* shownLine = "shown";
constexpr int lockAttempts = 20; // somebody may be looking whether it is locked
constexpr int lockWait = 5;      // milliseconds

QString dataFolder() { return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/rendered"; }

QByteArray headOf(const RunRequest& request)
{
  const QJsonObject head{ { "folder", request.folder }, { "arguments", QJsonArray::fromStringList(request.arguments) },
    { "scene", QString::fromLatin1(request.scene) } };
  return QJsonDocument(head).toJson(QJsonDocument::Compact) + '\n';
}

RunRequest parseHead(const QString& line)
{
  const QJsonObject head = QJsonDocument::fromJson(line.toUtf8()).object();
  RunRequest request;
  request.folder = head["folder"].toString();
  request.scene = head["scene"].toString().toLatin1();
  for (const auto& word : head["arguments"].toArray())
  {
    request.arguments << word.toString();
  }
  return request;
}
} // namespace

RunLog::RunLog(const QString& folder)
  : Folder(QDir::cleanPath(QDir::current().absoluteFilePath(folder)))
{
  this->Request.folder = this->Folder;
}

QString RunLog::folderOfLog() const
{
  const QByteArray name = QCryptographicHash::hash(this->Folder.toUtf8(), QCryptographicHash::Sha1).toHex().left(16);
  return dataFolder() + '/' + QString::fromLatin1(name);
}

QString RunLog::path() const { return this->folderOfLog() + '/' + logName; }

QStringList RunLog::folders()
{
  QStringList found;
  QList<QFileInfo> logs;
  for (const QFileInfo& folder : QDir(dataFolder()).entryInfoList(QDir::Dirs | QDir::NoDotAndDotDot))
  {
    logs << QFileInfo(folder.absoluteFilePath() + '/' + logName);
  }
  std::sort(logs.begin(), logs.end(),
    [](const QFileInfo& a, const QFileInfo& b) { return a.lastModified() > b.lastModified(); });
  for (const QFileInfo& log : logs)
  {
    QFile file(log.absoluteFilePath());
    const bool open = file.open(QIODevice::ReadOnly);
    const QString folder = open ? parseHead(QString::fromUtf8(file.readLine())).folder : QString();
    if (!folder.isEmpty())
    {
      found << folder;
    }
  }
  return found;
}

QString RunLog::sceneCopy() const
{
  QDir().mkpath(this->folderOfLog());
  return this->folderOfLog() + "/scene.json";
}

int RunLog::begin(const RunRequest& request) const
{
  QDir().mkpath(this->folderOfLog());
  const int file = ::open(QFile::encodeName(this->path()).constData(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  const QByteArray head = headOf(request);
  bool locked = false;
  for (int i = 0; file >= 0 && !locked && i < lockAttempts; ++i)
  {
    QThread::msleep(i == 0 ? 0 : lockWait);
    locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  }
  if (locked && ::ftruncate(file, 0) == 0 && ::write(file, head.constData(), std::size_t(head.size())) == head.size())
  {
    return file;
  }
  const int error = errno;
  ::close(file);
  errno = error;
  return -1;
}

bool RunLog::alive() const
{
  const int file = ::open(QFile::encodeName(this->path()).constData(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
  {
    return false;
  }
  const bool held = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return held;
}

QStringList RunLog::read()
{
  QStringList messages;
  QFile file(this->path());
  if (!file.open(QIODevice::ReadOnly) || !file.seek(this->Offset))
  {
    return messages;
  }
  const QByteArray text = file.readAll();
  int begin = 0;
  for (int at = text.indexOf('\n'); at >= 0; at = text.indexOf('\n', begin))
  {
    this->take(QString::fromUtf8(text.mid(begin, at - begin)), messages);
    begin = at + 1;
  }
  this->Offset += begin;
  return messages;
}

void RunLog::take(const QString& line, QStringList& messages)
{
  static const QRegularExpression state(QStringLiteral("^(\\d+)/(\\d+) \\w+, .*, \\S+ left$"));
  if (++this->Lines <= headLines)
  {
    this->Lines == 1 ? void(this->Request = parseHead(line)) : void(this->Process = line.toInt());
    return;
  }
  if (line == shownLine)
  {
    this->Shown = true;
    return;
  }
  const QRegularExpressionMatch match = state.match(line);
  if (match.hasMatch())
  {
    this->Done = match.captured(1).toInt();
    this->Total = match.captured(2).toInt();
    return;
  }
  const QString refused = QStringLiteral("dgtk: ");
  this->Refused = line.startsWith(refused);
  this->Last = this->Refused ? line.mid(refused.size()) : line;
  if (!this->Refused)
  {
    messages << line;
  }
}

RunLog::End RunLog::end() const
{
  static const QRegularExpression summary(QStringLiteral("^\\d+ pictures, \\d+ files in "));
  if (this->Refused)
  {
    return this->Last.startsWith("interrupted") ? End::Stopped : End::Failed;
  }
  return summary.match(this->Last).hasMatch() ? End::Done : End::Lost;
}

void RunLog::markShown() const
{
  QFile file(this->path());
  if (file.open(QIODevice::WriteOnly | QIODevice::Append | QIODevice::ExistingOnly))
  {
    file.write(QByteArray(shownLine) + '\n');
  }
}

void RunLog::remove() const { QFile::remove(this->path()); }

} // namespace dgtk
