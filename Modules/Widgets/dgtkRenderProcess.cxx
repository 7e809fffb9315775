// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderProcess.h"

#include <QCoreApplication>
#include <QRegularExpression>

#include <csignal>

#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr int niceness = 5;       // of 19
constexpr int longestEnd = 10000; // milliseconds
constexpr const char* secondsBetweenReports = "0.2";
} // namespace

QString shellLine(const QStringList& words)
{
  static const QRegularExpression plain("^[A-Za-z0-9_@%+=:,./-]+$");
  QStringList quoted;
  for (QString word : words)
  {
    quoted << (plain.match(word).hasMatch() ? word : '\'' + word.replace('\'', "'\\''") + '\'');
  }
  return quoted.join(' ');
}

void RenderProcess::Renderer::setupChildProcess()
{
  // Scripts start what runs in the background without SIGINT, and a child would lose a Cancel that comes early.
  ::signal(SIGINT, SIG_DFL);
  [[maybe_unused]] const int now = ::nice(niceness); // it renders as well without
}

RenderProcess::RenderProcess(QObject* parent)
  : QObject(parent)
{
  this->Process.setProcessChannelMode(QProcess::MergedChannels);
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("DGTK_PROGRESS", secondsBetweenReports);
  this->Process.setProcessEnvironment(environment);
  connect(&this->Process, &QProcess::readyRead, this, &RenderProcess::read);
  connect(&this->Process, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this, &RenderProcess::end);
  connect(&this->Process, &QProcess::errorOccurred, this,
    [this](QProcess::ProcessError error)
    {
      if (error == QProcess::FailedToStart)
      {
        emit this->finished(false, false, tr("%1 cannot be started: %2").arg(program(), this->Process.errorString()));
      }
    });
}

RenderProcess::~RenderProcess()
{
  this->disconnect();
  this->Process.disconnect();
  if (this->running())
  {
    this->cancel();
    if (!this->Process.waitForFinished(longestEnd))
    {
      this->Process.kill();
      this->Process.waitForFinished();
    }
  }
}

QString RenderProcess::program()
{
  const QString named = QString::fromLocal8Bit(qgetenv("DGTK"));
  return named.isEmpty() ? QCoreApplication::applicationDirPath() + "/dgtk" : named;
}

void RenderProcess::start(const QStringList& arguments)
{
  this->Unread.clear();
  this->Last.clear();
  this->Cancelled = false;
  this->Process.setStandardInputFile(QProcess::nullDevice());
  this->Process.start(program(), arguments);
}

void RenderProcess::cancel()
{
  // A signal is for the program, not for the copy of this one that is about to become it.
  if (this->running() && this->Process.waitForStarted(longestEnd))
  {
    // Two of a kind that come soon after one another are one.
    ::kill(static_cast<pid_t>(this->Process.processId()), this->Cancelled ? SIGKILL : SIGINT);
    this->Cancelled = true;
  }
}

void RenderProcess::read()
{
  this->Unread += this->Process.readAll();
  for (int at = this->Unread.indexOf('\n'); at >= 0; at = this->Unread.indexOf('\n'))
  {
    this->take(QString::fromUtf8(this->Unread.left(at)));
    this->Unread.remove(0, at + 1);
  }
}

void RenderProcess::take(const QString& text)
{
  static const QRegularExpression state(QStringLiteral("^(\\d+)/(\\d+) pictures, .*, \\S+ left$"));
  const QRegularExpressionMatch match = state.match(text);
  if (match.hasMatch())
  {
    emit this->progress(match.captured(1).toInt(), match.captured(2).toInt());
    return;
  }
  this->Last = text;
  emit this->line(text);
}

void RenderProcess::end(int code, QProcess::ExitStatus status)
{
  this->read();
  if (!this->Unread.isEmpty())
  {
    this->take(QString::fromUtf8(this->Unread));
    this->Unread.clear();
  }
  const bool ok = status == QProcess::NormalExit && code == 0;
  if (!ok && this->Last.isEmpty())
  {
    this->Last = tr("dgtk ended with status %1").arg(code);
  }
  emit this->finished(ok, this->Cancelled && !ok, this->Last);
}

} // namespace dgtk
