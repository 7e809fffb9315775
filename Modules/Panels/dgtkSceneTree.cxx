// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneTree.h"

#include "dgtkItemDialogs.h"

#include <QHeaderView>
#include <QLineEdit>
#include <QStyle>
#include <QTimer>

#include <set>
#include <utility>

namespace dgtk
{

namespace
{
constexpr int kindRole = Qt::UserRole;
constexpr int indexRole = Qt::UserRole + 1;

SceneItem itemOf(const QTreeWidgetItem* row)
{
  return { static_cast<SceneItem::Kind>(row->data(0, kindRole).toInt()),
    static_cast<std::size_t>(row->data(0, indexRole).toULongLong()) };
}
} // namespace

SceneTree::SceneTree(EditorState& state, QWidget* parent)
  : QTreeWidget(parent)
  , State(state)
{
  this->setObjectName("sceneTree");
  this->setColumnCount(2);
  this->setHeaderLabels({ tr("Name"), tr("Kind") });
  this->header()->setStretchLastSection(true);
  this->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  this->setSelectionMode(QAbstractItemView::ExtendedSelection);
  this->setEditTriggers(QAbstractItemView::EditKeyPressed);
  const QString names[3] = { tr("Objects"), tr("Lights"), tr("Cameras") };
  for (int kind = 0; kind < 3; ++kind)
  {
    this->Groups[kind] = new QTreeWidgetItem(this, { names[kind] });
    this->Groups[kind]->setFlags(Qt::ItemIsEnabled);
    this->Groups[kind]->setExpanded(true);
  }
  connect(&state, &EditorState::changed, this, &SceneTree::refresh);
  connect(&state, &EditorState::selectionChanged, this, &SceneTree::showSelection);
  connect(this, &QTreeWidget::itemSelectionChanged, this, &SceneTree::takeSelection);
  connect(this, &QTreeWidget::itemChanged, this, &SceneTree::takeName);
  connect(&state, &EditorState::typingEnds, this, &SceneTree::takeTyped);
  this->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(this, &QWidget::customContextMenuRequested, this,
    [this](const QPoint& at) { emit this->menuAsked(this->viewport()->mapToGlobal(at)); });
  this->refresh();
}

std::vector<std::string> SceneTree::listing() const
{
  const SceneDescription& scene = this->State.scene();
  std::vector<std::string> lines;
  for (const std::size_t i : this->State.document().absent())
  {
    lines.push_back("a" + std::to_string(i));
  }
  for (const ObjectDescription& object : scene.objects)
  {
    lines.push_back("o" + object.name + '\n' + object.className + (isEver(object.visible) ? "+" : "-"));
  }
  for (const LightDescription& light : scene.lights)
  {
    lines.push_back("l" + light.name + '\n' + std::to_string(static_cast<int>(light.kind)));
  }
  for (const CameraDescription& camera : scene.cameras)
  {
    lines.push_back("c" + camera.name + '\n' + camera.model);
  }
  return lines;
}

void SceneTree::refresh()
{
  std::vector<std::string> lines = this->listing();
  if (lines == this->Shown)
  {
    return;
  }
  this->Shown = std::move(lines);
  this->Busy = true;
  for (QTreeWidgetItem* group : this->Groups)
  {
    qDeleteAll(group->takeChildren());
  }
  const SceneDescription& scene = this->State.scene();
  const std::vector<std::size_t> boxes = this->State.document().absent();
  const std::set<std::size_t> absent(boxes.begin(), boxes.end());
  const QStringList lightNames = lightKindNames();
  for (const SceneItem& item : scene.items())
  {
    QString kind;
    if (item.kind == SceneItem::Kind::Camera)
    {
      kind = toText(scene.cameras[item.index].model);
    }
    else if (item.kind == SceneItem::Kind::Object)
    {
      const ObjectDescription& object = scene.objects[item.index];
      const QString name = toText(object.className);
      kind = isEver(object.visible) ? name : name.isEmpty() ? tr("hidden") : tr("%1, hidden").arg(name);
    }
    else
    {
      kind = lightNames[lightKindPlace(scene.lights[item.index].kind)];
    }
    auto* row = new QTreeWidgetItem(this->Groups[static_cast<int>(item.kind)], { toText(itemName(scene, item)), kind });
    row->setData(0, kindRole, static_cast<int>(item.kind));
    row->setData(0, indexRole, static_cast<qulonglong>(item.index));
    row->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable);
    if (item.kind == SceneItem::Kind::Object && absent.count(item.index) != 0)
    {
      row->setIcon(0, this->style()->standardIcon(QStyle::SP_MessageBoxWarning));
      row->setText(1, tr("missing"));
      row->setToolTip(0, tr("Its model is not there: %1").arg(toText(scene.objects[item.index].model)));
    }
  }
  this->Busy = false;
  this->showSelection();
}

void SceneTree::showSelection()
{
  if (this->Busy)
  {
    return;
  }
  this->Busy = true;
  QItemSelection chosen; // at once and by neighbours: row by row takes the square of their number
  QTreeWidgetItem* last = nullptr;
  for (QTreeWidgetItem* group : this->Groups)
  {
    for (int i = 0; i < group->childCount(); ++i)
    {
      if (this->State.isSelected(itemOf(group->child(i))))
      {
        const QModelIndex row = this->indexFromItem(group->child(i));
        const bool next = last != nullptr && i > 0 && last == group->child(i - 1);
        const QModelIndex first = next ? QModelIndex(chosen.takeLast().topLeft()) : row;
        chosen.append({ first, row });
        last = group->child(i);
      }
    }
  }
  this->selectionModel()->select(chosen, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  if (last != nullptr)
  {
    this->scrollToItem(last);
  }
  this->Busy = false;
}

void SceneTree::rename(const SceneItem& item)
{
  QTreeWidgetItem* const group = this->Groups[static_cast<int>(item.kind)];
  for (int i = 0; i < group->childCount(); ++i)
  {
    if (itemOf(group->child(i)) == item)
    {
      group->setExpanded(true);
      this->scrollToItem(group->child(i));
      this->setFocus();
      this->editItem(group->child(i), 0);
      return;
    }
  }
}

void SceneTree::takeSelection()
{
  if (this->Busy)
  {
    return;
  }
  SceneItems items;
  for (const QTreeWidgetItem* row : this->selectedItems())
  {
    items.push_back(itemOf(row));
  }
  this->Busy = true;
  this->State.select(items);
  this->Busy = false;
}

void SceneTree::takeName(QTreeWidgetItem* row)
{
  if (this->Busy || row->parent() == nullptr)
  {
    return;
  }
  const SceneItem item = itemOf(row);
  const std::string name = row->text(0).toStdString();
  if (name == itemName(this->State.scene(), item))
  {
    return;
  }
  this->Named.emplace(item, name);
  // Later: the edit makes the rows anew, and this one is still being edited.
  QTimer::singleShot(0, this, &SceneTree::renameNamed);
}

void SceneTree::renameNamed()
{
  const auto named = std::exchange(this->Named, std::nullopt);
  const auto rename = [&](SceneDescription& scene) { renameItem(scene, named->first, named->second); };
  if (named && !this->State.attempt([&] { this->State.document().edit("Rename", rename); }))
  {
    this->Shown.clear();
    this->refresh();
  }
}

void SceneTree::takeTyped()
{
  for (QLineEdit* editor : this->viewport()->findChildren<QLineEdit*>())
  {
    if (!editor->isHidden()) // others wait to be deleted
    {
      this->commitData(editor);
      this->closeEditor(editor, QAbstractItemDelegate::NoHint);
    }
  }
  this->renameNamed();
}

} // namespace dgtk
