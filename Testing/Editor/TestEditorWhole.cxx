// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditor.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QCheckBox>
#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTest>

namespace
{
constexpr int largeWidth = 2000; // pixels
}

void TestEditor::camerasHaveSizesOfTheirOwn()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QTabWidget*>()->setCurrentIndex(1);
  auto* cameras = dialog->findChild<QListWidget*>("cameras");
  auto* width = dialog->findChild<QSpinBox*>("width");
  auto* height = dialog->findChild<QSpinBox*>("height");
  cameras->setCurrentRow(1);
  QCOMPARE(width->value(), 640);
  width->setValue(320);
  height->setValue(200);
  QCOMPARE(cameras->currentRow(), 1);
  QCOMPARE(document.scene().cameras[1].width, 320);
  QCOMPARE(document.scene().cameras[1].height, 200);
  QCOMPARE(document.scene().cameras[0].width, 640);
  cameras->setCurrentRow(0);
  QCOMPARE(width->value(), 640);
  auto* own = dialog->findChild<QCheckBox*>("ownSize");
  own->setChecked(false);
  width->setValue(100);
  QCOMPARE(document.scene().cameras[0].width, 640);
  own->setChecked(true);
  QCOMPARE(width->value(), 640);
  cameras->setCurrentRow(1);
  QCOMPARE(height->value(), 200);
  document.undo(); // both numbers are one step
  QCOMPARE(document.json(), first);
  QCOMPARE(height->value(), 480);
}

void TestEditor::cancelledRunsResume()
{
  QVERIFY(this->Window->openFile(demo()));
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QLineEdit*>("folder")->setText(this->path("stopped"));
  // Large enough that the run is far from its end when its first file is seen.
  dialog->findChild<QCheckBox*>("ownSize")->setChecked(false);
  dialog->findChild<QSpinBox*>("width")->setValue(largeWidth);
  dialog->findChild<QSpinBox*>("height")->setValue(largeWidth);
  auto* start = dialog->findChild<QPushButton*>("start");
  QTest::mouseClick(start, Qt::LeftButton);
  QTRY_VERIFY_WITH_TIMEOUT(!contents(this->path("stopped")).isEmpty(), longestRun);
  QTest::mouseClick(dialog->findChild<QPushButton*>("cancel"), Qt::LeftButton);
  QTRY_VERIFY_WITH_TIMEOUT(start->isEnabled(), longestRun);
  QVERIFY(dialog->findChild<QCheckBox*>("resume")->isChecked());
  QVERIFY(!QFile::exists(this->path("stopped/manifest.json")));
  QTest::mouseClick(start, Qt::LeftButton);
  QTRY_VERIFY_WITH_TIMEOUT(start->isEnabled(), longestRun);
  QVERIFY(QFile::exists(this->path("stopped/manifest.json")));
}

void TestEditor::unsavedWorkSurvivesACrash()
{
  const QDir folder(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/unsaved");
  QVERIFY(this->Window->importFile(QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"))));
  const QString own = folder.filePath(QString::number(QCoreApplication::applicationPid()) + ".json");
  this->Window->findChild<QTimer*>("autosave")->start(1);
  QTRY_VERIFY(QFile::exists(own));
  const QString left = folder.filePath("999999999.json"); // no process has this number
  QFile::remove(left);
  QVERIFY(QFile::copy(own, left));
  this->Window = std::make_unique<dgtk::MainWindow>();
  QVERIFY2(!QFile::exists(own), "the regular end removes the copy");
  this->Window->show();
  answer<QMessageBox>("recoverBox", [](QMessageBox& box) { box.button(QMessageBox::Open)->click(); });
  this->Window->offerRecovery();
  QCOMPARE(this->Window->document().scene().objects.size(), std::size_t(1));
  QVERIFY(this->Window->document().modified());
  QVERIFY(this->Window->document().path().empty());
  QVERIFY(!QFile::exists(left));
}

void TestEditor::everyMenuItemWorks()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("house");
  QTimer closer;
  connect(&closer, &QTimer::timeout, &closeWhatIsOpen);
  closer.start(50);
  int items = 0;
  for (QMenu* menu : this->Window->findChildren<QMenu*>())
  {
    for (QAction* item : menu->actions())
    {
      if (!item->isSeparator() && item->menu() == nullptr && item->objectName() != "exit")
      {
        QVERIFY2(!item->text().isEmpty(), "a menu item without a text");
        item->trigger();
        QCoreApplication::processEvents();
        ++items;
      }
    }
  }
  QVERIFY(items > 25);
  QVERIFY(this->Window->isVisible());
  this->action("exit")->trigger();
  QVERIFY(!this->Window->isVisible());
}

void TestEditor::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  const auto grab = [&](QWidget* widget, const char* name)
  {
    QTest::qWait(3 * settle);
    QVERIFY(widget->grab().save(folder + '/' + name));
  };
  this->Window->resize(1280, 860);
  grab(this->Window.get(), "editor_empty.png");
  QVERIFY(this->Window->openFile(demo()));
  this->select("house");
  grab(this->Window.get(), "editor.png");
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QLineEdit*>("folder")->setText("/home/me/dataset");
  grab(dialog, "editor_render.png");
  dialog->findChild<QTabWidget*>()->setCurrentIndex(1);
  grab(dialog, "editor_render_cameras.png");
  dialog->hide();
  answer<QDialog>({},
    [&](QDialog& shown)
    {
      shown.grab().save(folder + "/editor_light.png");
      shown.reject();
    });
  this->action("light")->trigger();
}
