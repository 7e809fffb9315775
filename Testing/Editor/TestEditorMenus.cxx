// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorMenus.h"
#include "TestEditorSupport.h"

#include "dgtkDatasetViewer.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QDialog>
#include <QDockWidget>
#include <QImage>
#include <QMap>
#include <QMenu>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QPointer>
#include <QRegularExpression>
#include <QPushButton>
#include <QStatusBar>
#include <QTest>
#include <QTreeWidget>

#include <string>

namespace
{

/// What stands before the window, and the titles of other windows.
QString otherWindows(const QWidget* main)
{
  QStringList titles;
  for (const QWidget* widget : QApplication::topLevelWidgets())
  {
    if (widget->isVisible() && widget != main)
    {
      titles << widget->windowTitle();
    }
  }
  titles.sort();
  return titles.join('|');
}

/// As the user sees it, and the scene.
struct Seen
{
  QImage picture;
  std::string scene;
  QString windows;

  bool operator!=(const Seen& other) const
  {
    return this->scene != other.scene || this->windows != other.windows || this->picture != other.picture;
  }
};

Seen stateOf(dgtk::MainWindow& window)
{
  return { window.grab().toImage().convertToFormat(QImage::Format_RGB32), window.document().json(),
    otherWindows(&window) };
}
} // namespace

QList<QPointer<QAction>> TestEditorMenus::menuItems() const
{
  QList<QPointer<QAction>> items;
  for (QMenu* menu : this->Window->findChildren<QMenu*>())
  {
    for (QAction* item : menu->actions())
    {
      if (!item->isSeparator() && item->menu() == nullptr && item->objectName() != "exit")
      {
        items << item;
      }
    }
  }
  return items;
}

QString TestEditorMenus::fewObjects() const { return this->partOfDemo("few.json", { "tree", "vase" }); }

/// In both languages, also of the window of datasets.
void TestEditorMenus::lettersOfMenusDiffer()
{
  const auto check = [](const QMainWindow& window)
  {
    QList<QWidget*> bars{ window.menuBar() };
    for (QMenu* const menu : window.findChildren<QMenu*>())
    {
      bars << menu;
    }
    for (const QWidget* const bar : bars)
    {
      QMap<QString, QString> texts;
      for (const QAction* const action : bar->actions())
      {
        const QString text = QString(action->text()).remove("&&");
        const QString letter = text.mid(text.indexOf('&') + 1, 1).toLower();
        if (text.contains('&'))
        {
          QVERIFY2(!texts.contains(letter), qPrintable(text + " has the letter of " + texts[letter]));
          texts[letter] = text;
        }
      }
    }
  };
  check(*this->Window);
  check(dgtk::DatasetViewer());
  const German german;
  check(dgtk::MainWindow());
  check(dgtk::DatasetViewer());
}

/// Of 800 x 600 pixels, in both languages: for the two widest.
void TestEditorMenus::smallScreensHaveRoom()
{
  const QSize room(788, 556);
  const auto fits = [&](const QWidget& window)
  {
    const QSize least = window.minimumSizeHint();
    QVERIFY2(room.expandedTo(least) == room,
      qPrintable(window.objectName() + QString(" %1 x %2").arg(least.width()).arg(least.height())));
  };
  const auto bothFit = [&](dgtk::MainWindow& window)
  {
    window.show();
    untilQuiet();
    fits(window);
    window.findChild<QAction*>("correspondence")->trigger();
    fits(*window.findChild<QDialog*>("matchDialog"));
  };
  bothFit(*this->Window);
  const German german;
  dgtk::MainWindow window;
  bothFit(window);
}

/// In both languages: in a window of the usual size, and buttons without words where there is no room for these.
void TestEditorMenus::wordsHaveRoom()
{
  const auto check = [](dgtk::MainWindow& window)
  {
    window.show();
    window.findChild<QDockWidget*>("valuesDock")->raise();
    for (const QSize& size : { QSize(1280, 860), QSize(800, 600), QSize(1280, 860) })
    {
      window.resize(size);
      untilQuiet();
      for (const char* const name : { "makeKeyFrame", "removeKeyFrame" })
      {
        const auto* const button = window.findChild<QPushButton*>(name);
        QVERIFY2(button->width() >= button->sizeHint().width(), qPrintable(button->toolTip()));
        QVERIFY(button->text().isEmpty() != button->icon().isNull());
        QCOMPARE(button->text().isEmpty(), size.width() < 1280);
        QVERIFY(!button->shortcut().isEmpty());
      }
    }
    window.findChild<QAction*>("resetLayout")->trigger();
    window.findChild<QDockWidget*>("valuesDock")->raise();
    untilQuiet();
    const auto* const values = window.findChild<QTreeWidget*>("truthPanel");
    const QString hint = values->topLevelItem(0)->text(0);
    QVERIFY2(values->fontMetrics().horizontalAdvance(hint) + 12 < values->viewport()->width(), qPrintable(hint));
  };
  check(*this->Window);
  const German german;
  dgtk::MainWindow window;
  check(window);
}

void TestEditorMenus::theLayoutComesBack()
{
  constexpr int leastWidth = 220;
  const QSize usual(1280, 860);
  this->Window->resize(usual);
  untilQuiet();
  const auto places = [&]
  {
    QStringList all;
    for (const char* const name :
      { "treeDock", "propertiesDock", "timeDock", "logDock", "view.0", "view.3", "toolBar" })
    {
      const auto* const widget = this->Window->findChild<QWidget*>(name);
      const QRect at(widget->mapTo(this->Window.get(), QPoint(0, 0)), widget->size());
      all << QString("%1 %2 %3 %4 %5 %6")
               .arg(name)
               .arg(at.x())
               .arg(at.y())
               .arg(at.width())
               .arg(at.height())
               .arg(widget->isVisible());
    }
    return all;
  };
  this->action("resetLayout")->trigger(); // the window was small when it was shown
  untilQuiet();
  const QStringList first = places();
  QVERIFY2(first[0].section(' ', 3, 3).toInt() > leastWidth, qPrintable(first[0]));
  this->Window->resize(this->Window->minimumSizeHint());
  untilQuiet();
  this->Window->resize(usual);
  untilQuiet();
  for (const char* const name : { "treeDock", "propertiesDock" })
  {
    QVERIFY(this->Window->findChild<QWidget*>(name)->width() >= leastWidth);
  }
  this->Window->findChild<QDockWidget*>("timeDock")->setFloating(true);
  this->Window->findChild<QDockWidget*>("logDock")->close();
  this->Window->addDockWidget(Qt::LeftDockWidgetArea, this->Window->findChild<QDockWidget*>("treeDock"));
  this->Window->findChild<QWidget*>("toolBar")->hide();
  this->action("maximize")->trigger();
  untilQuiet();
  QVERIFY(places() != first);
  this->action("resetLayout")->trigger();
  untilQuiet();
  QCOMPARE(places().join("\n"), first.join("\n"));
}

void TestEditorMenus::tabStaysOnTheScreen()
{
  for (const char* const front : { "propertiesDock", "valuesDock" })
  {
    this->Window->findChild<QDockWidget*>(front)->raise();
    untilQuiet();
    QWidget* const first = this->Window->findChild<QWidget*>("truthLayer");
    first->setFocus();
    for (int i = 0; i < 12; ++i)
    {
      QVERIFY(QApplication::focusWidget() && (i > 0) == (QApplication::focusWidget() != first));
      QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
      QVERIFY(QApplication::focusWidget() && QApplication::focusWidget()->parentWidget());
      QVERIFY2(!QApplication::focusWidget()->parentWidget()->visibleRegion().isEmpty(),
        qPrintable(QApplication::focusWidget()->objectName()));
    }
  }
}

/// A scene with something to undo and to redo and a selection; what an item would show is not shown yet.
void TestEditorMenus::prepareFor(const QAction& item) const
{
  const QString name = item.objectName();
  this->Window->setUpdatesEnabled(false); // what is prepared is drawn once
  QVERIFY(this->Window->openFile(this->fewObjects()));
  this->select("tree");
  this->type("position.1", "0.25");
  this->type("position.1", "0.5");
  this->action("undo")->trigger();
  this->action("move")->trigger();
  this->action("textured")->trigger();
  this->action(name == "show.colour" ? "show.depth" : "show.colour")->trigger();
  if (name == "paste")
  {
    this->action("copy")->trigger();
  }
  else if (name == "copy")
  {
    this->select("vase");
  }
  else if (name == "preview")
  {
    this->select("left");
  }
  else if (name == "resetLayout")
  {
    this->action("maximize")->trigger();
  }
  else if (name == "move")
  {
    this->action("rotate")->trigger();
  }
  else if (name == "textured")
  {
    this->action("wireframe")->trigger();
  }
  else if (name == "frameSelected" || name == "frameAll")
  {
    QTest::keyClick(this->Window->findChild<QWidget*>("view.3"), Qt::Key_Plus);
  }
  this->Window->findChild<QWidget*>("view.3")->setFocus();
  this->Window->setUpdatesEnabled(true);
}

/// Each item of each menu changes the scene, the window, or opens another one.
void TestEditorMenus::everyMenuItemWorks()
{
  this->Window->statusBar()->hide(); // its messages come and go
  QVERIFY(this->Window->openFile(this->fewObjects()));
  QStringList asked;
  QTimer closer;
  connect(&closer, &QTimer::timeout,
    [&asked]
    {
      if (const QWidget* const dialog = QApplication::activeModalWidget())
      {
        asked << dialog->windowTitle();
      }
      closeWhatIsOpen();
    });
  closer.start(50);
  int items = 0;
  for (const QPointer<QAction>& item : this->menuItems())
  {
    if (item == nullptr || item->objectName() == "findModels")
    {
      continue; // of the recent files, which are others now; or for a scene whose models are missing
    }
    QVERIFY2(!item->text().isEmpty(), "a menu item without a text");
    this->prepareFor(*item);
    if (item == nullptr)
    {
      continue;
    }
    const QString name = item->objectName() + " " + item->text();
    QVERIFY2(item->isEnabled(), qPrintable(name));
    untilQuiet();
    auto* picture = this->Window->findChild<QWidget*>("truthPicture");
    QTRY_VERIFY(!picture->isVisible() || picture->property("settled").toBool());
    const Seen before = stateOf(*this->Window);
    asked.clear();
    const bool isCheckBox = item->isCheckable() && item->actionGroup() == nullptr;
    const bool copies = item->objectName() == "copy";
    item->trigger();
    if (copies)
    {
      this->action("paste")->trigger(); // not what was cut before
      QCOMPARE(this->Window->document().scene().objects.back().name, std::string("vase-2"));
    }
    QTRY_VERIFY2(!asked.isEmpty() || stateOf(*this->Window) != before, qPrintable(name));
    if (isCheckBox)
    {
      item->trigger();
    }
    for (QWidget* widget : QApplication::topLevelWidgets())
    {
      if (widget->isVisible() && widget != this->Window.get())
      {
        widget->close();
      }
    }
    ++items;
  }
  QVERIFY2(items > 45, qPrintable(QString::number(items)));
  QVERIFY(this->Window->isVisible());
  this->action("exit")->trigger();
  QVERIFY(!this->Window->isVisible());
}

/// Those of the window that are no letter with Ctrl, which the menus show where one looks for it.
void TestEditorMenus::helpNamesTheKeys()
{
  QStringList keys{ "Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+0", "Ctrl+9", "[", "]", "{", "}", "Shift+K", "Space" };
  for (const QPointer<QAction>& item : this->menuItems())
  {
    const QString key = item->shortcut().toString();
    if (!key.isEmpty() && !key.startsWith("Ctrl") && key != "F1")
    {
      keys << key;
    }
  }
  QVERIFY2(keys.contains("L") && keys.contains("Alt+Return") && keys.contains("Del"), qPrintable(keys.join(' ')));
  QStringList words;
  answer<QMessageBox>({},
    [&](QMessageBox& box)
    {
      words = box.text().split(QRegularExpression("[ ,.:;()<>]|br|/p"), Qt::SkipEmptyParts);
      box.accept();
    });
  this->action("mouse")->trigger();
  for (const QString& key : keys)
  {
    QVERIFY2(words.contains(key), qPrintable(key));
  }
}

void TestEditorMenus::whatIsDeletedWithAnObjectIsNamed()
{
  QVERIFY(this->Window->openFile(QString::fromStdString(dgtk::test::sourceFile("Data/Scenes/parenting.json"))));
  const auto* const log = this->Window->findChild<QPlainTextEdit*>("log");
  const QString before = log->toPlainText();
  this->select("floor");
  this->action("delete")->trigger();
  QCOMPARE(log->toPlainText(), before);
  this->select("turntable");
  this->action("delete")->trigger();
  const QString line = "7 objects deleted, among them what hangs on what was selected: axle, table, vase, ball, "
                       "creature, flag";
  QCOMPARE(log->toPlainText().split('\n').last().split(": ").first(), line.split(": ").first());
  const auto names = [](const QString& text)
  {
    QStringList list = text.section(": ", 1).split(", ");
    list.sort();
    return list;
  };
  QCOMPARE(names(log->toPlainText().split('\n').last()), names(line));
  QCOMPARE(this->Window->statusBar()->currentMessage(), log->toPlainText().split('\n').last());
  QVERIFY(this->Window->document().scene().objects.empty());
}

DGTK_EDITOR_TEST(TestEditorMenus);
