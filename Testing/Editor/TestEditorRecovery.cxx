// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditor.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAbstractButton>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QStandardPaths>
#include <QTest>
#include <QTimer>

void TestEditor::aDamagedCopyIsToldOfItsScene()
{
  const QDir folder(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/unsaved");
  QVERIFY(folder.mkpath("."));
  for (const QString& scene : { QString(), QString("/data/mine.json") })
  {
    for (const char* const text : { "{\n  \"objects\": [", "{ \"objects\": [{ \"model\": \"\" }] }" })
    {
      QFile copy(folder.filePath("left.json"));
      QFile lock(folder.filePath("left.json.lock"));
      QVERIFY(copy.open(QIODevice::WriteOnly) && lock.open(QIODevice::WriteOnly));
      copy.write(text);
      lock.write(scene.toUtf8());
      copy.close();
      lock.close();
      answer<QMessageBox>("recoverBox", [](QMessageBox& box) { box.button(QMessageBox::Open)->click(); });
      QString message;
      expectRefusal(message);
      this->Window->offerRecovery();
      const QString named = scene.isEmpty() ? "a scene without a name:" : scene + ':';
      QVERIFY2(message.startsWith(named) && !message.contains("unsaved"), qPrintable(message));
      QVERIFY2(copy.exists(), "it is not lost by that");
    }
  }
  QVERIFY(QFile::remove(folder.filePath("left.json")) && QFile::remove(folder.filePath("left.json.lock")));
}

void TestEditor::whatWasKeptIsDiscardedOrAskedAgain()
{
  const QDir folder(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/unsaved");
  QVERIFY(folder.mkpath("."));
  for (const char* const name : { "left.json", "other.json" })
  {
    QFile copy(folder.filePath(name));
    QVERIFY(copy.open(QIODevice::WriteOnly));
    copy.write("{ \"objects\": [] }");
  }
  const auto offered = [this](QMessageBox::StandardButton first, QMessageBox::StandardButton second)
  {
    int asked = 0;
    answer<QMessageBox>("recoverBox",
      [&](QMessageBox& box)
      {
        ++asked;
        answer<QMessageBox>("recoverBox",
          [&](QMessageBox& next)
          {
            ++asked;
            next.button(second)->click();
          });
        box.button(first)->click();
      });
    this->Window->offerRecovery();
    return asked;
  };
  QCOMPARE(offered(QMessageBox::Cancel, QMessageBox::Cancel), 2);
  QCOMPARE(folder.entryList({ "*.json" }, QDir::Files).size(), 2);
  QCOMPARE(offered(QMessageBox::Discard, QMessageBox::Cancel), 2);
  QCOMPARE(folder.entryList({ "*.json" }, QDir::Files).size(), 1);
  answer<QMessageBox>("recoverBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
  this->Window->offerRecovery();
  QVERIFY(QDir(folder).isEmpty());
  QVERIFY(!this->Window->document().modified());
}

void TestEditor::unsavedWorkSurvivesACrash()
{
  const QDir folder(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/unsaved");
  const auto copies = [&folder] { return QDir(folder).entryList({ "*.json" }, QDir::Files); };
  QVERIFY(this->Window->importFile(QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"))));
  QVERIFY(copies().isEmpty());
  this->Window->findChild<QTimer*>("autosave")->start(1);
  QTRY_COMPARE(copies().size(), 1);
  const QString own = folder.filePath(copies().first());
  {
    dgtk::MainWindow beside;
    beside.offerRecovery(); // of a window that lives: nothing is asked
    QVERIFY(beside.document().scene().objects.empty());
  }
  QVERIFY2(QFile::exists(own), "another window's end leaves it");
  const QString left = folder.filePath("left.json"); // nobody holds its lock
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
  QCOMPARE(copies().size(), 1); // the window's own: what was recovered may be lost again
  QVERIFY(this->Window->saveFile(this->path("kept.json")));
  QVERIFY2(QDir(folder).isEmpty(), "nothing is kept of work that is saved");

  // Work on a file is recovered under its name, unless the file was saved since.
  for (const bool savedSince : { false, true })
  {
    this->select("crate-1");
    this->type("position.0", savedSince ? "2" : "1");
    this->Window->findChild<QTimer*>("autosave")->start(1);
    QTRY_COMPARE(copies().size(), 1);
    const QString copy = folder.filePath(copies().first());
    QVERIFY(QFile::copy(copy, folder.filePath("left.json")));
    QVERIFY(QFile::copy(copy + ".lock", folder.filePath("left.json.lock")));
    QVERIFY(QFile::copy(copy, folder.filePath("other.json"))); // of another crash
    this->Window = std::make_unique<dgtk::MainWindow>();
    this->Window->show();
    QFile file(this->path("kept.json"));
    QVERIFY(file.open(QIODevice::ReadWrite));
    QVERIFY(
      file.setFileTime(QDateTime::currentDateTime().addSecs(savedSince ? 60 : -60), QFileDevice::FileModificationTime));
    file.close();
    QFile newest(folder.filePath("left.json"));
    QVERIFY(newest.open(QIODevice::ReadWrite));
    QVERIFY(newest.setFileTime(QDateTime::currentDateTime().addSecs(10), QFileDevice::FileModificationTime));
    newest.close();
    QString question;
    answer<QMessageBox>("recoverBox",
      [&question](QMessageBox& box)
      {
        question = box.text();
        box.button(QMessageBox::Open)->click();
      });
    this->Window->offerRecovery();
    QVERIFY2(question.contains("kept.json"), qPrintable(question));
    QCOMPARE(this->Window->document().path(), savedSince ? std::string() : this->Folder.path("kept.json"));
    QVERIFY(this->Window->document().modified());
    const auto* log = this->Window->findChild<QPlainTextEdit*>("log");
    QVERIFY2(log->toPlainText().contains("other unsaved work, too (1)"), qPrintable(log->toPlainText()));
    QVERIFY(QFile::remove(folder.filePath("other.json")));
    QFile::remove(folder.filePath("other.json.lock"));
    QVERIFY(this->Window->saveFile(this->path("kept.json")));
  }
}
