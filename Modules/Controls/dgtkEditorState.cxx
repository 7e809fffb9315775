// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorState.h"

#include "dgtkError.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <exception>
#include <map>
#include <new>
#include <utility>

namespace dgtk
{

namespace
{
/// What is wrong with the scene itself: a line of its file says nothing of the scene as it is edited.
std::string withoutPlace(const InputError& error, const std::string& title)
{
  const std::string what = error.what();
  const std::string line = error.line() >= 1 ? ':' + std::to_string(error.line()) : std::string();
  const std::string place = printable(title) + line + ": ";
  return error.file() == title && what.rfind(place, 0) == 0 ? what.substr(place.size()) : what;
}
} // namespace

EditorState::EditorState(QObject* parent)
  : QObject(parent)
{
  this->Document.onChange([this] { this->afterChange(); });
}

bool EditorState::isSelected(const SceneItem& item) const
{
  return std::find(this->Selection.begin(), this->Selection.end(), item) != this->Selection.end();
}

void EditorState::rememberNames()
{
  this->SelectedNames.clear();
  for (const SceneItem& item : this->Selection)
  {
    this->SelectedNames.push_back(itemName(this->scene(), item));
  }
  this->Counts[0] = this->scene().objects.size();
  this->Counts[1] = this->scene().lights.size();
  this->Counts[2] = this->scene().cameras.size();
}

void EditorState::select(const SceneItems& items)
{
  if (items != this->Selection)
  {
    this->Selection = items;
    this->rememberNames();
    emit this->selectionChanged();
  }
}

void EditorState::toggle(const SceneItem& item)
{
  SceneItems items = this->Selection;
  const auto at = std::find(items.begin(), items.end(), item);
  if (at == items.end())
  {
    items.push_back(item);
  }
  else
  {
    items.erase(at);
  }
  this->select(items);
}

void EditorState::afterChange()
{
  const SceneDescription& scene = this->scene();
  SceneItems kept = this->Selection;
  if (this->Counts[0] != scene.objects.size() || this->Counts[1] != scene.lights.size() ||
      this->Counts[2] != scene.cameras.size())
  {
    // Things came or went: what was selected is found by its name.
    std::map<std::pair<SceneItem::Kind, std::string>, SceneItem> named;
    for (const SceneItem& item : scene.items())
    {
      named.emplace(std::pair(item.kind, itemName(scene, item)), item);
    }
    kept.clear();
    for (std::size_t i = 0; i < this->Selection.size(); ++i)
    {
      const auto at = named.find({ this->Selection[i].kind, this->SelectedNames[i] });
      if (at != named.end())
      {
        kept.push_back(at->second);
      }
    }
  }
  const bool other = kept != this->Selection;
  this->Selection = kept;
  this->rememberNames();
  emit this->changed();
  if (other)
  {
    emit this->selectionChanged();
  }
}

void EditorState::setFrame(int frame)
{
  const int within = std::clamp(frame, 0, largestFrame);
  if (within != this->Frame)
  {
    this->Frame = within;
    emit this->frameChanged(within);
  }
}

bool EditorState::attempt(const std::function<void()>& edit)
{
  try
  {
    edit();
    return true;
  }
  catch (const std::bad_alloc&)
  {
    emit this->failed(tr("The memory of this machine is not enough."));
  }
  catch (const InputError& error)
  {
    emit this->failed(toText(withoutPlace(error, this->scene().title())));
  }
  catch (const std::exception& error)
  {
    emit this->failed(QString::fromUtf8(error.what()));
  }
  return false;
}

SceneDescription EditorState::selectedFamilies() const
{
  return extractItems(this->scene(), withChildren(this->scene(), this->Selection));
}

void EditorState::copy()
{
  if (!this->Selection.empty())
  {
    this->Clipboard = this->selectedFamilies();
    emit this->copied();
    emit this->selectionChanged(); // Paste is possible now
  }
}

void EditorState::cut()
{
  this->copy();
  this->attempt(
    [this]
    {
      const SceneItems items = this->Selection;
      if (!items.empty())
      {
        this->Document.edit("Cut", [&](SceneDescription& scene) { removeItems(scene, items); });
      }
    });
}

void EditorState::remove()
{
  this->attempt([this] { this->Document.remove(SceneItems(this->Selection)); });
}

void EditorState::paste()
{
  if (this->canPaste())
  {
    this->pasteItems(this->Clipboard);
  }
}

void EditorState::pasteItems(const SceneDescription& part)
{
  this->attempt([&] { this->select(this->Document.paste("Paste", part)); });
}

void EditorState::duplicate()
{
  if (!this->Selection.empty())
  {
    this->attempt([this] { this->select(this->Document.paste("Duplicate", this->selectedFamilies())); });
  }
}

} // namespace dgtk
