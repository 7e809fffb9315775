// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEditorLog_h
#define dgtkEditorLog_h

#include <QPlainTextEdit>

#include <cstddef>
#include <string>
#include <vector>

namespace dgtk
{

class SceneDocument;

/// What has happened, a line each.
class EditorLog : public QPlainTextEdit
{
  Q_OBJECT

public:
  explicit EditorLog(QWidget* parent);

  void note(const QString& line);
  void noteWarnings(const std::vector<std::string>& lines);
  /// What the scene's models are warned of and is not said yet.
  void noteNewWarnings(const SceneDocument& document);
  /// Warnings of the scene's models that are said.
  std::size_t warned() const { return this->Warned; }
  void setWarned(std::size_t count) { this->Warned = count; }
  /// The status bar keeps only the last line: it says that there are others.
  static QString withWarnings(const QString& line, std::size_t warnings);

signals:
  void noted(const QString& line);

private:
  std::size_t Warned = 0;
  std::size_t Opened = 0; ///< SceneDocument::opened() of that scene
};

} // namespace dgtk

#endif
