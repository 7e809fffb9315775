// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneClipboard.h"

#include "dgtkEditorState.h"
#include "dgtkSceneFragment.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QMimeData>

#include <filesystem>
#include <optional>

namespace dgtk
{

namespace
{
const QString partOfAScene = QStringLiteral("application/x-dgtk-scene-part");

const QMimeData* onClipboard() { return QGuiApplication::clipboard()->mimeData(); }
} // namespace

SceneClipboard::SceneClipboard(EditorState& state, QObject* parent)
  : QObject(parent)
  , State(state)
{
  connect(&state, &EditorState::copied, this, &SceneClipboard::put);
  connect(QGuiApplication::clipboard(), &QClipboard::dataChanged, this, &SceneClipboard::look);
  this->look();
}

void SceneClipboard::look()
{
  const QMimeData* const data = onClipboard();
  this->IsOffered = data != nullptr && (data->hasFormat(partOfAScene) || data->hasText());
  emit this->changed();
}

std::string SceneClipboard::folder() const
{
  const std::string& file = this->State.document().path();
  return file.empty() ? this->State.scene().folder : std::filesystem::path(file).parent_path().string();
}

void SceneClipboard::put()
{
  this->State.attempt(
    [this]
    {
      const SceneDescription& part = this->State.clipboard();
      this->Own = QByteArray::fromStdString(packFragment(part));
      auto* data = new QMimeData;
      data->setData(partOfAScene, this->Own);
      data->setText(QString::fromStdString(fragmentText(part, this->folder())));
      QGuiApplication::clipboard()->setMimeData(data);
    });
}

bool SceneClipboard::canPaste() const { return this->State.canPaste() || this->IsOffered; }

void SceneClipboard::paste()
{
  const QMimeData* const data = onClipboard();
  const bool isPart = data != nullptr && data->hasFormat(partOfAScene);
  const QByteArray bytes = isPart ? data->data(partOfAScene) : QByteArray();
  std::optional<SceneDescription> part;
  if (isPart && bytes != this->Own)
  {
    part = unpackFragment(bytes.toStdString());
  }
  else if (!isPart && data != nullptr && data->hasText())
  {
    part = readFragment(data->text().toStdString(), this->folder());
  }
  if (part)
  {
    this->State.pasteItems(*part);
  }
  else if (this->State.canPaste())
  {
    this->State.paste(); // foreign words on the clipboard do not take away what was copied here
  }
  else
  {
    emit this->told(tr("The clipboard has no part of a scene"));
  }
}

} // namespace dgtk
