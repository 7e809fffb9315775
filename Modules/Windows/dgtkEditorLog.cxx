// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorLog.h"

#include "dgtkSceneDocument.h"

namespace dgtk
{

namespace
{
constexpr std::size_t mostWarnings = 20; // of one reading
constexpr int mostLines = 2000;
} // namespace

EditorLog::EditorLog(QWidget* parent)
  : QPlainTextEdit(parent)
{
  this->setObjectName("log");
  this->setReadOnly(true);
  this->setMaximumBlockCount(mostLines);
  this->setPlaceholderText(tr("What happens is written here."));
}

void EditorLog::note(const QString& line)
{
  this->appendPlainText(line);
  emit this->noted(line);
}

void EditorLog::noteWarnings(const std::vector<std::string>& lines)
{
  for (std::size_t i = 0; i < lines.size() && i < mostWarnings; ++i)
  {
    this->note(tr("Warning: %1").arg(QString::fromStdString(lines[i])));
  }
  if (lines.size() > mostWarnings)
  {
    this->note(tr("%1 more warnings: dgtk info shows all of them").arg(lines.size() - mostWarnings));
  }
}

void EditorLog::noteNewWarnings(const SceneDocument& document)
{
  const std::vector<std::string>& all = document.models().warnings();
  this->Warned = document.opened() == this->Opened ? this->Warned : 0;
  this->Opened = document.opened();
  this->noteWarnings({ all.begin() + std::ptrdiff_t(this->Warned), all.end() });
  this->Warned = all.size();
}

QString EditorLog::withWarnings(const QString& line, std::size_t warnings)
{
  return warnings == 0 ? line : tr("%1; warnings in the log: %2").arg(line, QString::number(warnings));
}

} // namespace dgtk
