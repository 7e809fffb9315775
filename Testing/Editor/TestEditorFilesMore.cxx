// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorFiles.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkModelReader.h"
#include "dgtkRenderDialog.h"
#include "dgtkSceneDocument.h"
#include "dgtkSceneViews.h"

#include <QAction>
#include <QCheckBox>
#include <QDialog>
#include <QDockWidget>
#include <QDropEvent>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QProcess>
#include <QProgressBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSettings>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTest>
#include <QUrl>

#include <algorithm>
#include <csignal>

namespace
{
constexpr int largeWidth = 1600; // pixels of a picture that takes a while
} // namespace

void TestEditorFiles::filesAreDropped()
{
  QMimeData data;
  data.setUrls({ QUrl::fromLocalFile(model("crate.ac")), QUrl("http://example.org/tree.obj"),
    QUrl::fromLocalFile(model("windmill.gltf")) });
  QDragEnterEvent enter({ 20, 20 }, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(this->Window.get(), &enter);
  QVERIFY(enter.isAccepted());
  QDropEvent drop({ 20, 20 }, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(this->Window.get(), &drop);
  QVERIFY(this->Window->findChild<QPlainTextEdit*>("log")->toPlainText().contains(
    "http://example.org/tree.obj is not opened: it is no file of this machine"));
  const dgtk::SceneDocument& document = this->Window->document();
  QTRY_COMPARE(document.scene().objects.size(), std::size_t(2));
  QCOMPARE(document.scene().objects[1].name, std::string("windmill-1"));
  QMimeData words;
  words.setText("no file");
  QDragEnterEvent text({ 20, 20 }, Qt::CopyAction, &words, Qt::LeftButton, Qt::NoModifier);
  text.setAccepted(false);
  QApplication::sendEvent(this->Window.get(), &text);
  QVERIFY(!text.isAccepted());
}

void TestEditorFiles::inFileDialog(const char* action, const std::function<void(QFileDialog&)>& act) const
{
  answer<QFileDialog>({}, act);
  this->action(action)->trigger();
}

void TestEditorFiles::theImportDialogKnowsAllFormats()
{
  QStringList filters;
  this->inFileDialog("import",
    [&](QFileDialog& dialog)
    {
      filters = dialog.nameFilters();
      dialog.setDirectory(model(""));
      dialog.findChild<QLineEdit*>("fileNameEdit")->setText("\"crate.ac\" \"windmill.gltf\"");
      QTest::keyClick(dialog.findChild<QLineEdit*>("fileNameEdit"), Qt::Key_Return);
    });
  QCOMPARE(filters.size(), int(dgtk::modelReaders().size()) + 1);
  for (const dgtk::ReaderInfo& reader : dgtk::modelReaders())
  {
    for (const std::string& extension : reader.extensions)
    {
      const QString pattern = "*." + QString::fromStdString(extension);
      QVERIFY2(filters.first().contains(pattern), qPrintable(pattern));
      QCOMPARE(filters.filter(QRegularExpression(QRegularExpression::escape(pattern) + "[ )]")).size(), 2);
    }
  }
  QTRY_COMPARE(this->Window->document().scene().objects.size(), std::size_t(2));
}

void TestEditorFiles::name(QFileDialog& dialog, const QString& path, const QString& filter)
{
  auto* field = dialog.findChild<QLineEdit*>("fileNameEdit");
  if (!filter.isEmpty())
  {
    dialog.selectNameFilter(filter);
  }
  field->setText(path);
  QTest::keyClick(field, Qt::Key_Return);
}

void TestEditorFiles::savingAsksAboutTheFileThatItWrites()
{
  QVERIFY(this->import(model("crate.ac")).isEmpty());
  const QString thesis = "Thesis scene (*.scene)";
  const QString json = this->write("precious.json", "precious");
  const QString scene = this->write("precious.v2.scene", "precious");
  this->inFileDialog("saveAs", [&](QFileDialog& dialog) { name(dialog, this->path("precious"), thesis); });
  QCOMPARE(this->Window->document().path(), this->Folder.path("precious.scene"));
  QCOMPARE(contentsOf(json), QByteArray("precious"));

  QString question;
  answer<QMessageBox>("replaceBox",
    [&](QMessageBox& box)
    {
      question = box.text();
      answer<QFileDialog>({}, [](QFileDialog& dialog) { dialog.reject(); });
      box.button(QMessageBox::No)->click();
    });
  this->inFileDialog("saveAs", [&](QFileDialog& dialog) { name(dialog, this->path("precious.v2"), thesis); });
  QVERIFY2(question.contains("precious.v2.scene"), qPrintable(question));
  QCOMPARE(contentsOf(scene), QByteArray("precious"));

  answer<QMessageBox>("replaceBox", [](QMessageBox& box) { box.button(QMessageBox::Yes)->click(); });
  this->inFileDialog("saveAs", [&](QFileDialog& dialog) { name(dialog, json, thesis); });
  QCOMPARE(this->Window->document().path(), json.toStdString());
  QVERIFY(contentsOf(json) != QByteArray("precious"));
}

void TestEditorFiles::savingAsksAboutWhatItDestroys()
{
  const QByteArray mine = R"({ "objects": [ { "name": "box", "model": "box.obj" } ] } // precious)";
  this->write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const QString scene = this->write("a<b>b<br>.json", mine);
  QVERIFY(this->Window->openFile(scene));
  const auto save = [&](const char* question, const char* button)
  {
    QString said;
    answer<QMessageBox>("overwriteBox",
      [&](QMessageBox& box)
      {
        said = box.text();
        QCOMPARE(box.textFormat(), Qt::PlainText);
        button == nullptr ? QTest::keyClick(&box, Qt::Key_Escape) : box.findChild<QPushButton*>(button)->click();
      });
    this->action("save")->trigger();
    QVERIFY2(said.startsWith("a<b>b<br>.json ") && said.contains(question), qPrintable(said));
  };
  save("comments", nullptr);
  QCOMPARE(contentsOf(scene), mine);
  save("comments", "overwrite");
  const QByteArray saved = contentsOf(scene);
  QVERIFY(saved != mine && !saved.contains("precious"));
  this->action("save")->trigger(); // there is nothing to ask about
  const QByteArray theirs = R"({ "units": "theirs" })";
  this->write("a<b>b<br>.json", theirs);
  save("another program", nullptr);
  QCOMPARE(contentsOf(scene), theirs);
  answer<QFileDialog>({}, [&](QFileDialog& dialog) { name(dialog, this->path("mine.json")); });
  save("another program", "saveAs");
  QCOMPARE(contentsOf(scene), theirs);
  QCOMPARE(contentsOf(this->path("mine.json")), saved);

  // A model that has changed is named when numbers are asked for.
  const auto* log = this->Window->findChild<QPlainTextEdit*>("log");
  const QString warning = "Warning: " + this->path("box.obj") + " has changed";
  this->action("show.depth")->trigger();
  QVERIFY(!log->toPlainText().contains(warning));
  this->write("box.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
  this->action("show.colour")->trigger();
  QVERIFY2(log->toPlainText().contains(warning), qPrintable(log->toPlainText()));
  const auto change = [&](const char* side)
  { this->write("box.obj", "v 0 0 0\nv 2 0 0\nv 0 " + QByteArray(side) + " 0\nf 1 2 3\n"); };
  change("33");
  emit this->Window->findChild<dgtk::SceneViews*>()->lookedThrough({});
  QCOMPARE(log->toPlainText().count(warning), 2);
  change("444");
  this->action("render")->trigger();
  auto* const rendering = this->Window->findChild<dgtk::RenderDialog*>();
  emit rendering->started();
  QCOMPARE(log->toPlainText().count(warning), 3);
  rendering->close();
}

void TestEditorFiles::everyFileIsAskedAbout()
{
  QVERIFY(this->import(model("crate.ac")).isEmpty());
  const QString pov = this->write("precious.pov", "precious");
  answer<QMessageBox>("replaceBox",
    [&](QMessageBox& box)
    {
      answer<QFileDialog>({}, [](QFileDialog& dialog) { dialog.reject(); });
      box.button(QMessageBox::No)->click();
    });
  this->inFileDialog("exportPov", [&](QFileDialog& dialog) { name(dialog, this->path("precious")); });
  QTest::qWait(settle);
  QCOMPARE(contentsOf(pov), QByteArray("precious"));
  QVERIFY(QApplication::activeModalWidget() == nullptr);
}

void TestEditorFiles::exportsForPovRay()
{
  QVERIFY(this->import(model("crate.ac")).isEmpty());
  const QString file = this->path("crate.pov");
  this->inFileDialog("exportPov", [&](QFileDialog& dialog) { name(dialog, this->path("crate")); });
  QTRY_VERIFY(QFile::exists(file));
  QCOMPARE(dgtk::readModel(file.toStdString())->triangles.size(),
    dgtk::readModel(model("crate.ac").toStdString())->triangles.size());
  const QString povray = QStandardPaths::findExecutable("povray");
  if (!povray.isEmpty())
  {
    QProcess process;
    process.setWorkingDirectory(this->path("."));
    process.start(povray, { "+Icrate.pov", "+Ocrate.png", "+W32", "+H24", "-D" });
    QVERIFY(process.waitForFinished(longestRun));
    QCOMPARE(process.exitCode(), 0);
    QVERIFY(QFile::exists(this->path("crate.png")));
  }
  // Of several cameras the one that is selected.
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("right");
  this->inFileDialog("exportPov", [&](QFileDialog& dialog) { name(dialog, this->path("right")); });
  const QByteArray written = contentsOf(this->path("right.pov"));
  QVERIFY(written.startsWith("// Camera 'right', frame 0."));
  QVERIFY2(written.contains(", 0.2, 1.75, 5.4> scale "), "its eye");
}

void TestEditorFiles::filesOfTheCommandLineOpen()
{
  QProcess editor;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  const QString settings = this->path("config");
  environment.insert("XDG_CONFIG_HOME", settings);
  environment.insert("XDG_DATA_HOME", this->path("data"));
  editor.setProcessEnvironment(environment);
  editor.start(QCoreApplication::applicationDirPath() + "/dgtk-editor", { this->copyOfDemo(), model("crate.ac") });
  QTRY_VERIFY(contentsOf(settings + "/DGTk/Editor.conf").contains("demo.json"));
  QCOMPARE(editor.state(), QProcess::Running);
  editor.kill();
  QVERIFY(editor.waitForFinished(longestRun));
}

void TestEditorFiles::recentFilesOpenAgain()
{
  const QString scene = this->copyOfDemo();
  QVERIFY(this->Window->openFile(scene));
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->show();
  auto* recent = this->Window->findChild<QMenu*>("recent");
  QCOMPARE(recent->actions().size(), 1);
  QVERIFY(recent->actions().first()->text().contains("demo.json"));
  recent->actions().first()->trigger();
  QTRY_COMPARE(QString::fromStdString(this->Window->document().path()), scene);
}

void TestEditorFiles::recentFilesThatAreGoneAreForgotten()
{
  const QString scene = this->copyOfDemo();
  QVERIFY(this->Window->openFile(scene));
  const QString gone = this->path("gone.json");
  QVERIFY(this->Window->saveFile(gone));
  QVERIFY(QFile::remove(gone));
  auto* const recent = this->Window->findChild<QMenu*>("recent");
  QCOMPARE(recent->actions().size(), 2);
  QString said;
  expectRefusal(said);
  recent->actions().first()->trigger();
  QTRY_VERIFY2(said.contains("gone.json"), qPrintable(said));
  QTRY_COMPARE(recent->actions().size(), 1);
  QVERIFY(recent->actions().first()->text().contains("demo.json"));
  QCOMPARE(QSettings().value("recent").toStringList(), QStringList{ scene });
}

/// The box that says why a file cannot be written offers another one; the one about unsaved work names the file.
void TestEditorFiles::whatCannotBeWrittenGoesElsewhere()
{
  const QString scene = this->copyOfDemo();
  QVERIFY(this->Window->openFile(scene));
  this->Window->document().edit("none", [](dgtk::SceneDescription& one) { one.units = "cm"; });
  const QString other = this->path("other.json");
  QString said;
  answer<QMessageBox>("errorBox",
    [&](QMessageBox& box)
    {
      said = box.text();
      answer<QFileDialog>({},
        [&](QFileDialog& dialog)
        {
          auto* const field = dialog.findChild<QLineEdit*>("fileNameEdit");
          field->setText(other);
          QTest::keyClick(field, Qt::Key_Return);
        });
      QTest::mouseClick(box.findChild<QPushButton*>("saveAs"), Qt::LeftButton);
    });
  QVERIFY(this->Window->saveFile(this->path("none/of/these.json")));
  QVERIFY2(said.contains("these.json"), qPrintable(said));
  QVERIFY(QFile::exists(other));
  QVERIFY(!this->Window->document().modified());
  QCOMPARE(QString::fromStdString(this->Window->document().path()), other);
  this->Window->document().edit("none", [](dgtk::SceneDescription& one) { one.units = "m"; });
  answer<QMessageBox>("unsavedBox",
    [&](QMessageBox& box)
    {
      said = box.text();
      box.reject();
    });
  QVERIFY(!this->Window->close());
  QCOMPARE(said, QString("other.json has changes that are not saved."));
  this->Window->document().undo();
}

void TestEditorFiles::anyNameIsShownAsItIs()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const QString scene = this->path("R&D %2.json");
  QVERIFY(this->Window->saveFile(scene));
  QVERIFY(this->Window->openFile(scene));
  auto* log = this->Window->findChild<QPlainTextEdit*>("log");
  QVERIFY2(
    log->toPlainText().contains("Opened R&D %2.json: 5 objects, 3 lights, 2 cameras"), qPrintable(log->toPlainText()));
  auto* recent = this->Window->findChild<QMenu*>("recent");
  QVERIFY(recent->actions().first()->text().contains("R&&D %2.json"));
  const QString crate = this->path("R&D.ac");
  QVERIFY(QFile::copy(model("crate.ac"), crate));
  QVERIFY(this->import(crate).isEmpty());
  QVERIFY2(this->action("undo")->text().contains("R&&D.ac"), qPrintable(this->action("undo")->text()));
  QString said;
  expectRefusal(said);
  QVERIFY(!this->Window->openFile(this->path("s") + QChar(QChar::ReplacementCharacter) + ".json"));
  QVERIFY2(said.contains("is not UTF-8"), qPrintable(said));
}

void TestEditorFiles::theLogsCommandIsForAShell()
{
  const QString folder = this->path("Anna's $HOME & data");
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  auto* field = dialog->findChild<QLineEdit*>("folder");
  field->setText(folder);
  dialog->findChild<QCheckBox*>("ownSize")->setChecked(false);
  dialog->findChild<QSpinBox*>("width")->setValue(largeWidth);
  auto* start = dialog->findChild<QPushButton*>("start");
  QTest::mouseClick(start, Qt::LeftButton);
  QVERIFY(!field->isEnabled());
  QTest::mouseClick(dialog->findChild<QPushButton*>("cancel"), Qt::LeftButton);
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(field->isEnabled());
  const QStringList lines = this->Window->findChild<QPlainTextEdit*>("log")->toPlainText().split('\n');
  const QStringList commands = lines.filter(QRegularExpression("^dgtk render "));
  QCOMPARE(commands.size(), 1);
  QProcess shell;
  shell.start("/bin/sh", { "-c", QString(commands.first()).replace(0, 4, "printf '%s\\n'") });
  QVERIFY(shell.waitForFinished(longestRun));
  const QStringList words = QString::fromUtf8(shell.readAllStandardOutput()).split('\n');
  QCOMPARE(words.value(words.indexOf("-o") + 1), folder);
  QVERIFY(words.indexOf("-o") > 0);
}

void TestEditorFiles::theWindowIsAsItWasLeft()
{
  this->Window->resize(1111, 777);
  this->Window->findChild<QDockWidget*>("logDock")->hide();
  untilQuiet();
  const QSize size = this->Window->size();
  QVERIFY(this->Window->close());
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->show();
  QVERIFY(QTest::qWaitForWindowExposed(this->Window.get(), longestRun));
  QTRY_COMPARE(this->Window->size(), size);
  QVERIFY(!this->Window->findChild<QDockWidget*>("logDock")->isVisible());
  QVERIFY(this->Window->findChild<QDockWidget*>("timeDock")->isVisible());
}

QDialog* TestEditorFiles::largeRun(const char* folder, int size) const
{
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QLineEdit*>("folder")->setText(this->path(folder));
  dialog->findChild<QCheckBox*>("ownSize")->setChecked(false);
  dialog->findChild<QSpinBox*>("width")->setValue(size);
  dialog->findChild<QSpinBox*>("height")->setValue(size);
  return dialog;
}

/// Cancel, and Cancel again while a picture is drawn that takes minutes.
void TestEditorFiles::aLargeRunEndsAtOnce()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const QDialog* const dialog = this->largeRun("hours", 8 * largeWidth);
  auto* start = dialog->findChild<QPushButton*>("start");
  auto* cancel = dialog->findChild<QPushButton*>("cancel");
  const auto* status = dialog->findChild<QLabel*>("status");
  QTest::mouseClick(start, Qt::LeftButton);
  QTRY_VERIFY(status->text().startsWith("Pictures: 0"));
  QTest::mouseClick(cancel, Qt::LeftButton);
  QVERIFY2(status->text().contains("Cancel again"), qPrintable(status->text()));
  QTest::mouseClick(cancel, Qt::LeftButton);
  QTRY_VERIFY(start->isEnabled());
  QVERIFY2(status->text().startsWith("Stopped."), qPrintable(status->text()));
  QVERIFY(!QFile::exists(this->path("hours/manifest.json")));
}

/// Cancel before dgtk knows of signals, in an editor that ignores them as those that a script starts in the background.
void TestEditorFiles::aRunEndsThatHasJustBegun()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const QDialog* const dialog = this->largeRun("hours", 8 * largeWidth);
  auto* start = dialog->findChild<QPushButton*>("start");
  const auto before = std::signal(SIGINT, SIG_IGN);
  QTest::mouseClick(start, Qt::LeftButton);
  QTest::mouseClick(dialog->findChild<QPushButton*>("cancel"), Qt::LeftButton);
  std::signal(SIGINT, before);
  QTRY_VERIFY(start->isEnabled());
  const QString said = dialog->findChild<QLabel*>("status")->text();
  QVERIFY2(said.startsWith("Stopped."), qPrintable(said));
}

void TestEditorFiles::theProgressOfARunMoves()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const QDialog* const dialog = this->largeRun("progress", 4 * largeWidth);
  auto* bar = dialog->findChild<QProgressBar*>("progress");
  auto* start = dialog->findChild<QPushButton*>("start");
  auto* cancel = dialog->findChild<QPushButton*>("cancel");
  int last = -1;
  int still = 0;
  int stillest = 0;
  int looks = 0;
  int moves = 0;
  QTimer looker;
  connect(&looker, &QTimer::timeout, &looker,
    [&]
    {
      const bool counting = bar->maximum() > 1 && !start->isEnabled();
      const bool moved = counting && bar->value() > last;
      QVERIFY(!counting || bar->value() >= last);
      moves += moved ? 1 : 0;
      looks += counting ? 1 : 0;
      still = moved || !counting ? 0 : still + 1;
      stillest = std::max(stillest, still);
      last = counting ? bar->value() : -1;
    });
  looker.start(100);
  QTest::mouseClick(start, Qt::LeftButton);
  QTRY_VERIFY(moves > 8 || start->isEnabled());
  QTest::mouseClick(cancel, Qt::LeftButton);
  looker.stop();
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(moves > 4);
  qInfo("%d moves in %d looks, at most %d looks without a move", moves, looks, stillest);
  QVERIFY2(
    stillest < std::max(5 * patience(), 0.5 * looks), "no move for many times half a second, and half of the time");
}
