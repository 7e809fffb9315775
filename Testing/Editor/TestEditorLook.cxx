// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorLook.h"
#include "TestEditorSupport.h"

#include "dgtkEditorLanguage.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAbstractButton>
#include <QAction>
#include <QDialog>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QOpenGLWidget>
#include <QProcess>
#include <QTest>
#include <QTranslator>
#include <QXmlStreamReader>

#include <set>

using dgtk::test::sourceFile;

namespace
{
constexpr int nearEdge = 2; // pixels of the window on either side of an edge

QString text(const char* relative) { return QString::fromStdString(sourceFile(relative)); }

/// English strings that are others in German, from the translation's source.
QMap<QString, QString> germanOfEnglish()
{
  QMap<QString, QString> german;
  QFile file(text("Modules/Widgets/Translations/dgtk-editor_de.ts"));
  file.open(QIODevice::ReadOnly);
  QXmlStreamReader xml(&file);
  QString english;
  while (!xml.atEnd())
  {
    xml.readNext();
    if (xml.isStartElement() && xml.name() == QLatin1String("source"))
    {
      english = xml.readElementText();
    }
    else if (xml.isStartElement() && xml.name() == QLatin1String("translation"))
    {
      german[english] = xml.readElementText(QXmlStreamReader::IncludeChildElements).trimmed();
    }
  }
  return german;
}

/// Everything that is written on a widget and what is in it.
QStringList written(const QWidget& widget)
{
  QStringList all{ widget.windowTitle(), widget.toolTip() };
  for (const QAction* action : widget.findChildren<QAction*>())
  {
    all << action->text();
  }
  for (const QLabel* label : widget.findChildren<QLabel*>())
  {
    all << label->text();
  }
  for (const QAbstractButton* button : widget.findChildren<QAbstractButton*>())
  {
    all << button->text() << button->toolTip();
  }
  for (const QDockWidget* dock : widget.findChildren<QDockWidget*>())
  {
    all << dock->windowTitle();
  }
  return all;
}
} // namespace

QImage TestEditorLook::picture(const char* view) const
{
  auto* widget = this->Window->findChild<QOpenGLWidget*>(view);
  QTest::qWait(settle);
  return widget->grabFramebuffer();
}

void TestEditorLook::viewsHaveAllPixelsOfTheDisplay()
{
  QVERIFY(this->Window->openFile(demo()));
  auto* view = this->Window->findChild<QOpenGLWidget*>("view.3");
  const QImage shown = this->picture("view.3");
  QCOMPARE(shown.size(), (QSizeF(view->size()) * view->devicePixelRatioF()).toSize());
  // Neighbours within a pixel of the window differ somewhere: nothing was enlarged.
  int different = 0;
  for (int y = 0; y + 1 < shown.height(); y += 2)
  {
    for (int x = 0; x + 1 < shown.width(); x += 2)
    {
      different += shown.pixel(x, y) != shown.pixel(x + 1, y) ? 1 : 0;
    }
  }
  QVERIFY2(different > shown.width(), qPrintable(QString::number(different)));
}

void TestEditorLook::clicksMeetWhatIsSeen()
{
  QVERIFY(this->Window->importFile(text("Data/Models/crate.ac")));
  dgtk::SceneDocument& document = this->Window->document();
  auto* view = this->Window->findChild<QOpenGLWidget*>("view.0");
  const double ratio = view->devicePixelRatioF();
  const auto clickIn = [&](int x)
  {
    QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(3, 3));
    QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(x, view->height() / 2));
    QCoreApplication::processEvents();
    const QLineEdit* const name = this->field("name");
    return name != nullptr && name->isVisible();
  };
  QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(3, 3));
  const QImage with = this->picture("view.0");
  document.edit("hide", [](dgtk::SceneDescription& scene) { scene.objects[0].visible = false; });
  const QImage without = this->picture("view.0");
  document.undo();
  int first = -1;
  int last = -1;
  for (int x = 0; x < with.width(); ++x)
  {
    if (with.pixel(x, with.height() / 2) != without.pixel(x, with.height() / 2))
    {
      first = first < 0 ? x : first;
      last = x;
    }
  }
  QVERIFY(first > 0 && last > first + 20 * ratio && last + 1 < with.width());
  const int left = int(first / ratio);
  const int right = int((last + 1) / ratio);
  QVERIFY(clickIn(left + nearEdge));
  QVERIFY(!clickIn(left - nearEdge));
  QVERIFY(clickIn(right - nearEdge));
  QVERIFY(!clickIn(right + nearEdge));
}

void TestEditorLook::germanIsShownEverywhere()
{
  QVERIFY(dgtk::setEditorLanguage("de"));
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->show();
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("house");
  this->action("duplicate")->trigger();
  QStringList all = written(*this->Window);
  for (const char* name : { "camera", "cameraArray", "light" })
  {
    answer<QDialog>({},
      [&](QDialog& dialog)
      {
        all << written(dialog);
        dialog.reject();
      });
    this->action(name)->trigger();
  }
  this->action("render")->trigger();
  all << written(*this->Window->findChild<QDialog*>("renderDialog"));
  QCOMPARE(this->action("open")->text(), QString::fromUtf8("\u00d6&ffnen ..."));
  QCOMPARE(this->action("undo")->text(), QString::fromUtf8("&R\u00fcckg\u00e4ngig: Duplizieren"));
  const QMap<QString, QString> german = germanOfEnglish();
  QVERIFY(german.size() > 200);
  const std::set<QString> words(german.begin(), german.end());
  for (const QString& one : all)
  {
    // A word of the scene itself may be an English one; none is in the demo scene.
    QVERIFY2(!german.contains(one) || german[one] == one || words.count(one) != 0, qPrintable(one));
  }
  this->Window.reset();
  for (QTranslator* translator : qApp->findChildren<QTranslator*>())
  {
    delete translator;
  }
}

void TestEditorLook::languagesAreNamed()
{
  QVERIFY(dgtk::editorLanguages().contains("de"));
  QVERIFY(!dgtk::setEditorLanguage("tlh"));
  QProcess editor;
  const QString program = QCoreApplication::applicationDirPath() + "/dgtk-editor";
  editor.start(program, { "--language", "tlh" });
  QVERIFY(editor.waitForFinished(longestRun));
  QCOMPARE(editor.exitCode(), 2);
  QVERIFY(editor.readAllStandardError().trimmed().endsWith(
    "dgtk-editor: --language: expected one of en, de, found 'tlh' (see dgtk-editor --help)"));
  editor.start(program, { "--languaje" });
  QVERIFY(editor.waitForFinished(longestRun));
  QCOMPARE(editor.exitCode(), 2);
}

void TestEditorLook::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  dgtk::setEditorLanguage("de");
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->show();
  this->Window->resize(1280, 860);
  QVERIFY(this->Window->openFile(demo()));
  this->select("creature");
  QTest::qWait(3 * settle);
  QVERIFY(this->Window->findChild<QWidget*>("propertiesPanel")->grab().save(folder + "/editor_german.png"));
}

int main(int argc, char** argv) { return runEditorTest<TestEditorLook>(argc, argv); }
