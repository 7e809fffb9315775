// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorLanguage.h"

#include "dgtkSceneDescription.h"

#include <QCoreApplication>
#include <QDir>
#include <QLibraryInfo>
#include <QLocale>
#include <QTranslator>

#include <iterator>

namespace dgtk
{

namespace
{
constexpr const char* translations = ":/dgtk/translations";
constexpr const char* stem = "dgtk-editor_";

// Named in parts without Qt, which do not translate.
[[maybe_unused]] const char* const edits[] = { QT_TRANSLATE_NOOP("Edit", "Add camera"),
  QT_TRANSLATE_NOOP("Edit", "Add camera array"), QT_TRANSLATE_NOOP("Edit", "Add light"),
  QT_TRANSLATE_NOOP("Edit", "Change frame rate"), QT_TRANSLATE_NOOP("Edit", "Change the lens"),
  QT_TRANSLATE_NOOP("Edit", "Set image size"), QT_TRANSLATE_NOOP("Edit", "Change interpolation"),
  QT_TRANSLATE_NOOP("Edit", "Change interpolation of keys"), QT_TRANSLATE_NOOP("Edit", "Change speed of sequence"),
  QT_TRANSLATE_NOOP("Edit", "Choose sequence"), QT_TRANSLATE_NOOP("Edit", "Copy key frame"),
  QT_TRANSLATE_NOOP("Edit", "Copy keys"), QT_TRANSLATE_NOOP("Edit", "Cut"), QT_TRANSLATE_NOOP("Edit", "Delete"),
  QT_TRANSLATE_NOOP("Edit", "Duplicate"), QT_TRANSLATE_NOOP("Edit", "Find models"), QT_TRANSLATE_NOOP("Edit", "Import"),
  QT_TRANSLATE_NOOP("Edit", "Make key frame"), QT_TRANSLATE_NOOP("Edit", "Move"),
  QT_TRANSLATE_NOOP("Edit", "Move key frame"), QT_TRANSLATE_NOOP("Edit", "Move keys"),
  QT_TRANSLATE_NOOP("Edit", "Move sequence"), QT_TRANSLATE_NOOP("Edit", "Paste"),
  QT_TRANSLATE_NOOP("Edit", "Paste key frame"), QT_TRANSLATE_NOOP("Edit", "Remove key frame"),
  QT_TRANSLATE_NOOP("Edit", "Remove keys"), QT_TRANSLATE_NOOP("Edit", "Rename"),
  QT_TRANSLATE_NOOP("Edit", "Repeat sequence"), QT_TRANSLATE_NOOP("Edit", "Rotate"),
  QT_TRANSLATE_NOOP("Edit", "Scale") };

// Sentences of parts without Qt, and of the library where a dialog shows them beside the value.
[[maybe_unused]] const char* const messages[] = { QT_TRANSLATE_NOOP(
                                                    "Message", "it needs a frame of the scene after the picture's own"),
  QT_TRANSLATE_NOOP(
    "Message", "it needs a frame of the scene after the picture's own, and two cameras side by side at both"),
  QT_TRANSLATE_NOOP("Message", "it needs a frame of the scene before the picture's own"),
  QT_TRANSLATE_NOOP(
    "Message", "it needs a frame of the scene before the picture's own, and two cameras side by side at both"),
  QT_TRANSLATE_NOOP(
    "Message", "it needs another camera in the run, or a pair of cameras that ends within the frames of the scene"),
  QT_TRANSLATE_NOOP("Message",
    "it needs two cameras side by side: the same K but cx, the same orientation, displaced along the x axis"),
  QT_TRANSLATE_NOOP("Message", "the pixel is outside the image"),
  QT_TRANSLATE_NOOP("Message", "the point is outside the image"),
  QT_TRANSLATE_NOOP("Message", "number of cameras: expected 1 to 10000"),
  QT_TRANSLATE_NOOP("Message", "columns and rows: expected 1 to 10000 cameras in all"),
  QT_TRANSLATE_NOOP("Message", "spacing: expected a number above 0"),
  QT_TRANSLATE_NOOP("Message", "path: expected at least two different points"),
  QT_TRANSLATE_NOOP("Message", "eye, look-at or up of a camera is not finite"),
  QT_TRANSLATE_NOOP("Message", "eye and look-at of a camera coincide"),
  QT_TRANSLATE_NOOP("Message", "up vector of a camera is zero or parallel to its view") };

// Those that layers have.
[[maybe_unused]] const char* const units[] = { QT_TRANSLATE_NOOP("Unit", "pixels"),
  QT_TRANSLATE_NOOP("Unit", "scene units"), QT_TRANSLATE_NOOP("Unit", "1 / scene units"),
  QT_TRANSLATE_NOOP("Unit", "object units"), QT_TRANSLATE_NOOP("Unit", "linear sRGB"),
  QT_TRANSLATE_NOOP("Unit", "camera response") };

// In the order of their numbers.
const char* const visibilities[] = { QT_TRANSLATE_NOOP("Visibility", "no surface"),
  QT_TRANSLATE_NOOP("Visibility", "visible"), QT_TRANSLATE_NOOP("Visibility", "occluded by another object"),
  QT_TRANSLATE_NOOP("Visibility", "occluded by its own object"), QT_TRANSLATE_NOOP("Visibility", "outside the image"),
  QT_TRANSLATE_NOOP("Visibility", "behind the camera") };

// Buttons of Qt's dialogs, for systems without Qt's own translations.
[[maybe_unused]] const char* const buttons[] = { QT_TRANSLATE_NOOP("QPlatformTheme", "OK"),
  QT_TRANSLATE_NOOP("QPlatformTheme", "Save"), QT_TRANSLATE_NOOP("QPlatformTheme", "Open"),
  QT_TRANSLATE_NOOP("QPlatformTheme", "&Yes"), QT_TRANSLATE_NOOP("QPlatformTheme", "&No"),
  QT_TRANSLATE_NOOP("QPlatformTheme", "Cancel"), QT_TRANSLATE_NOOP("QPlatformTheme", "Close"),
  QT_TRANSLATE_NOOP("QPlatformTheme", "Discard"), QT_TRANSLATE_NOOP("QPlatformTheme", "Apply"),
  QT_TRANSLATE_NOOP("QPlatformTheme", "Reset") };

void install(const QString& name, const QString& folder)
{
  auto* translator = new QTranslator(QCoreApplication::instance());
  if (translator->load(name, folder))
  {
    QCoreApplication::installTranslator(translator);
  }
}
} // namespace

QStringList editorLanguages()
{
  QStringList languages{ "en" };
  for (const QString& file : QDir(translations).entryList({ QString(stem) + "*.qm" }))
  {
    languages << file.mid(int(qstrlen(stem)), file.size() - int(qstrlen(stem)) - 3);
  }
  return languages;
}

bool setEditorLanguage(const QString& language)
{
  const QString wanted = language.isEmpty() ? QLocale::system().name().section('_', 0, 0) : language;
  if (!editorLanguages().contains(wanted))
  {
    return language.isEmpty();
  }
  if (wanted != "en")
  {
    install("qtbase_" + wanted, QLibraryInfo::location(QLibraryInfo::TranslationsPath));
    install(stem + wanted, translations);
  }
  return true;
}

QString editText(const std::string& text)
{
  const QString words = QString::fromStdString(text);
  QString whole = QCoreApplication::translate("Edit", text.c_str());
  if (whole != words)
  {
    return whole;
  }
  // A verb and a name.
  const QString verb = words.section(' ', 0, 0);
  return QCoreApplication::translate("Edit", verb.toUtf8().constData()) + words.mid(verb.size());
}

QString messageText(const std::string& text)
{
  return text.empty() ? QString() : QCoreApplication::translate("Message", text.c_str());
}

QString contentsText(const SceneDescription& scene)
{
  const auto counted = [](std::size_t count, const char* one, const char* more)
  {
    return count == 1 ? QCoreApplication::translate("Contents", one)
                      : QCoreApplication::translate("Contents", more).arg(count);
  };
  return counted(scene.objects.size(), QT_TRANSLATE_NOOP("Contents", "1 object"),
           QT_TRANSLATE_NOOP("Contents", "%1 objects")) +
         ", " +
         counted(
           scene.lights.size(), QT_TRANSLATE_NOOP("Contents", "1 light"), QT_TRANSLATE_NOOP("Contents", "%1 lights")) +
         ", " +
         counted(scene.cameras.size(), QT_TRANSLATE_NOOP("Contents", "1 camera"),
           QT_TRANSLATE_NOOP("Contents", "%1 cameras"));
}

QString visibilityText(std::uint32_t value)
{
  return value < std::size(visibilities) ? QCoreApplication::translate("Visibility", visibilities[value])
                                         : QCoreApplication::translate("Visibility", "unknown class");
}

QString unitText(const std::string& unit)
{
  return unit.empty() ? QString() : QCoreApplication::translate("Unit", unit.c_str());
}

} // namespace dgtk
