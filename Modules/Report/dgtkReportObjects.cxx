// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportObjects.h"

#include "dgtkError.h"
#include "dgtkLayerColors.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace dgtk
{

namespace
{
constexpr std::size_t mostRows = 200;
constexpr const char* boxesDocument = "boxes";

/// A row of the table of objects or of classes.
struct SeenRow
{
  std::uint32_t id = 0; ///< in the first scene that has it
  std::string name;
  std::string objectClass;
  std::set<std::size_t> scenes;
  std::uint64_t members = 0; ///< objects of a class
  std::uint64_t pictures = 0;
  std::uint64_t pixels = 0;
};
using SeenRows = std::map<std::string, SeenRow>; ///< by what is the same in all scenes

std::string keyOf(const ObjectRecord& object) { return object.name + '\0' + object.objectClass; }

ReportJson rowsJson(const SeenRows& rows)
{
  std::vector<const SeenRow*> sorted;
  for (const auto& [key, row] : rows)
  {
    sorted.push_back(&row);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
    [](const SeenRow* a, const SeenRow* b)
    { return std::make_tuple(b->pixels, b->pictures, a->id) < std::make_tuple(a->pixels, a->pictures, b->id); });
  sorted.resize(std::min(sorted.size(), mostRows));
  ReportJson list = ReportJson::array();
  for (const SeenRow* row : sorted)
  {
    list.push_back({ { "id", row->id }, { "name", utf8FromBytes(row->name) },
      { "class", utf8FromBytes(row->objectClass) }, { "scenes", row->scenes.size() }, { "members", row->members },
      { "pictures", row->pictures }, { "pixels", row->pixels } });
  }
  return list;
}

SeenRows objectRows(const ReportSource& source)
{
  SeenRows rows;
  for (std::size_t scene = 0; scene < source.scenes.size(); ++scene)
  {
    for (const ObjectRecord& object : source.scenes[scene].view->objects())
    {
      SeenRow& row =
        rows.emplace(keyOf(object), SeenRow{ object.id, object.name, object.objectClass, {} }).first->second;
      row.scenes.insert(scene);
    }
  }
  return rows;
}

SeenRows classRows(const ReportSource& source)
{
  SeenRows rows;
  for (std::size_t scene = 0; scene < source.scenes.size(); ++scene)
  {
    const DatasetView& view = *source.scenes[scene].view;
    for (const ClassRecord& one : view.classes())
    {
      rows.emplace(one.name, SeenRow{ one.id, one.name, {}, {} }).first->second.scenes.insert(scene);
    }
    for (const ObjectRecord& object : view.objects())
    {
      const auto row = rows.find(object.objectClass);
      if (row != rows.end())
      {
        ++row->second.members;
      }
    }
  }
  return rows;
}

void addSeen(SeenRows& rows, const std::string& key, std::uint64_t pixels)
{
  const auto row = rows.find(key);
  if (row != rows.end() && pixels > 0)
  {
    ++row->second.pictures;
    row->second.pixels += pixels;
  }
}

void addObjects(
  const ReportSource& source, const std::map<std::size_t, IdTally>& seen, SeenRows& objects, SeenRows* classes)
{
  for (const auto& [picture, ids] : seen)
  {
    const DatasetView& view = source.viewOf(source.pictures[picture]);
    std::map<std::string, std::uint64_t> ofClass;
    for (const auto& [id, pixels] : ids)
    {
      if (const ObjectRecord* const object = view.object(id))
      {
        addSeen(objects, keyOf(*object), pixels);
        ofClass[object->objectClass] += pixels;
      }
    }
    for (const auto& [name, pixels] : ofClass)
    {
      if (classes != nullptr)
      {
        addSeen(*classes, name, pixels);
      }
    }
  }
}

void addClasses(const ReportSource& source, const std::map<std::size_t, IdTally>& seen, SeenRows& classes)
{
  for (const auto& [picture, ids] : seen)
  {
    for (const ClassRecord& one : source.viewOf(source.pictures[picture]).classes())
    {
      const auto pixels = ids.find(one.id);
      addSeen(classes, one.name, pixels == ids.end() ? 0 : pixels->second);
    }
  }
}

/// What the lists of boxes of the pictures that are read say.
ReportJson boxesJson(const ReportSource& source, std::vector<std::string>& notes)
{
  NumberTally sizes;
  ShareTally shares{ 20 };
  std::uint64_t pictures = 0;
  std::uint64_t hidden = 0;
  for (const std::size_t picture : source.read)
  {
    const ReportPicture& one = source.pictures[picture];
    const DatasetView& view = source.viewOf(one);
    if (view.file(*one.shot, boxesDocument, { "json" }).empty())
    {
      continue;
    }
    try
    {
      for (const BoxRecord& box : view.boxes(*one.shot))
      {
        hidden += box.pixelsVisible == 0;
        if (box.pixelsAmodal > 0)
        {
          shares.add(double(box.pixelsVisible) / double(box.pixelsAmodal));
        }
        if (box.visible)
        {
          const Eigen::Vector4d& b = *box.visible;
          sizes.add(std::max(b[2] - b[0], b[3] - b[1]));
        }
      }
      ++pictures;
    }
    catch (const Error& error)
    {
      notes.emplace_back(error.what());
    }
  }
  if (pictures == 0)
  {
    return nullptr;
  }
  return { { "pictures", pictures }, { "hidden", hidden }, { "sizes", sizes.json() }, { "shares", shares.json() } };
}
} // namespace

ReportJson objectsSeen(const ReportSource& source, const std::map<std::size_t, IdTally>& objects,
  const std::map<std::size_t, IdTally>& classes, std::vector<std::string>& notes)
{
  SeenRows rows = objectRows(source);
  SeenRows ofClass = classRows(source);
  addObjects(source, objects, rows, classes.empty() ? &ofClass : nullptr);
  addClasses(source, classes, ofClass);
  return { { "counted", !objects.empty() }, { "classesCounted", !classes.empty() || !objects.empty() },
    { "objectCount", rows.size() }, { "classCount", ofClass.size() }, { "objects", rowsJson(rows) },
    { "classes", rowsJson(ofClass) }, { "boxes", boxesJson(source, notes) } };
}

ReportJson namesOf(const ReportSource& source)
{
  constexpr std::size_t mostNames = 5000;
  std::set<std::size_t> scenes;
  for (const std::size_t picture : source.shown)
  {
    scenes.insert(source.pictures[picture].scene);
  }
  ReportJson names = ReportJson::object();
  for (const std::size_t scene : scenes)
  {
    const DatasetView& view = *source.scenes[scene].view;
    ReportJson objects = ReportJson::array();
    for (const ObjectRecord& object : view.objects())
    {
      if (objects.size() < mostNames)
      {
        objects.push_back({ object.id, utf8FromBytes(object.name), utf8FromBytes(object.objectClass) });
      }
    }
    ReportJson classes = ReportJson::array();
    for (const ClassRecord& one : view.classes())
    {
      classes.push_back({ one.id, utf8FromBytes(one.name) });
    }
    names[std::to_string(scene)] = { { "name", utf8FromBytes(source.scenes[scene].name) }, { "objects", objects },
      { "classes", classes } };
  }
  return names;
}

} // namespace dgtk
