// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorRuns.h"
#include "TestEditorSupport.h"

#include "dgtkSceneDescription.h"

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>

#include <csignal>

namespace
{
constexpr const char* size[2] = { "96", "64" }; // pixels
constexpr const char* layer = "depth";
constexpr int lastFrame = 100; // far from the end when the first picture is there
constexpr const char* firstPicture = "left/depth/000000.npy";
constexpr int hashDigits = 64;
constexpr const char* asEditor = "--editor";

void fillIn(const QDialog& dialog, const QString& folder)
{
  for (QCheckBox* box : dialog.findChildren<QCheckBox*>())
  {
    if (box->objectName().startsWith("layer."))
    {
      box->setChecked(box->text() == layer);
    }
  }
  dialog.findChild<QCheckBox*>("ownSize")->setChecked(false);
  dialog.findChild<QSpinBox*>("width")->setValue(QString(size[0]).toInt());
  dialog.findChild<QSpinBox*>("height")->setValue(QString(size[1]).toInt());
  dialog.findChild<QLineEdit*>("folder")->setText(folder);
}

/// Renders a scene into a folder (the words after the program's name) as a user does, until it is ended from outside.
int beEditor(int argc, char** argv)
{
  const QString scene = QString::fromLocal8Bit(argv[1]);
  const QString folder = QString::fromLocal8Bit(argv[2]);
  dgtk::MainWindow::prepareApplication();
  QApplication application(argc, argv);
  dgtk::MainWindow::setupApplication();
  dgtk::MainWindow window;
  window.resize(window.minimumSizeHint());
  window.show();
  window.openFile(scene);
  window.findChild<QAction*>("render")->trigger();
  const auto* dialog = window.findChild<QDialog*>("renderDialog");
  fillIn(*dialog, folder);
  dialog->findChild<QPushButton*>("start")->click();
  return QApplication::exec();
}

/// A dgtk whose run is held when its first picture is there and in its journal, if a file "hold" is, which goes then.
/// It goes on by moments until there: it does not end before it is looked at, and the window may be late. Such a moment
/// is a wait of the shell's own: the start of a program that sleeps took longer than the whole run.
QByteArray stoppingProgram(const QString& folder)
{
  return QString(
    "#!/bin/bash\ncd '%1' && [ -e hold ] && (\n"
    "  exec 3<> <(:)\n"
    "  while kill -0 $$; do\n"
    "    kill -STOP $$\n"
    "    grep -qE '^[0-9a-f]{64}.*%3$' out/.dgtk-journal && [ ! -e out/manifest.json ] && rm hold && exit\n"
    "    kill -CONT $$\n"
    "    read -rt 0.005 -u 3\n"
    "  done) </dev/null >/dev/null 2>&1 &\n"
    "exec '%2' \"$@\"\n")
    .arg(folder, QString::fromLocal8Bit(qgetenv("DGTK")), firstPicture)
    .toLocal8Bit();
}

/// The journal of a run that was killed before it entered a file, which it had planned.
void dropEntry(const QString& path, const char* file)
{
  QFile journal(path);
  QVERIFY(journal.open(QIODevice::ReadWrite));
  QByteArray kept;
  int dropped = 0;
  while (!journal.atEnd())
  {
    const QByteArray line = journal.readLine();
    const bool isEntry = line.endsWith(QByteArray(file) + '\n') && line.indexOf('\t') == hashDigits;
    dropped += isEntry ? 1 : 0;
    kept += isEntry ? QByteArray() : line;
  }
  QCOMPARE(dropped, 1);
  journal.resize(0);
  QVERIFY(journal.seek(0) && journal.write(kept) == kept.size());
}

bool isStopped(pid_t process)
{
  QFile state(QString("/proc/%1/stat").arg(process));
  return state.open(QIODevice::ReadOnly) && state.readAll().contains(") T ");
}

void clickIn(const char* box, const char* button)
{
  answer<QMessageBox>(box, [button](QMessageBox& shown) { shown.findChild<QPushButton*>(button)->click(); });
}
} // namespace

void TestEditorRuns::prepare(bool open)
{
  QDir(this->path("out")).removeRecursively();
  QFile program(this->path("dgtk"));
  if (!program.exists())
  {
    QVERIFY(program.open(QIODevice::WriteOnly));
    program.write(stoppingProgram(this->path("")));
    program.setPermissions(QFile::ReadOwner | QFile::ExeOwner | QFile::WriteOwner);
    program.close();
    qputenv("DGTK", program.fileName().toLocal8Bit());
  }
  this->Scene = this->path("long.json");
  if (!QFile::exists(this->Scene))
  {
    dgtk::SceneDescription scene = dgtk::readScene(demo().toStdString());
    scene.objects[0].position.keys = { { 0, Eigen::Vector3d(0, 0, 0) }, { lastFrame, Eigen::Vector3d(0, 1, 0) } };
    dgtk::writeScene(scene, this->Scene.toStdString());
  }
  QVERIFY(!open || this->Window->openFile(this->Scene));
}

QDialog* TestEditorRuns::dialog() const
{
  this->action("render")->trigger();
  return this->Window->findChild<QDialog*>("renderDialog");
}

/// The next run stops when its first picture is there.
void TestEditorRuns::holdNext() const { QVERIFY(QFile(this->path("hold")).open(QIODevice::WriteOnly)); }

void TestEditorRuns::waitUntilHeld() const
{
  QTRY_VERIFY(!QFile::exists(this->path("hold")));
  // A process that waits for its disk stops when it has got what it waits for.
  QTRY_VERIFY(!livingRuns().isEmpty() && isStopped(livingRuns().first()));
  QVERIFY2(!QFile::exists(this->path("out/manifest.json")), "the run was to be held before its end");
}

void TestEditorRuns::sendAll(int signal)
{
  for (const pid_t run : livingRuns())
  {
    ::kill(run, signal);
  }
}

void TestEditorRuns::letGo() { sendAll(SIGCONT); }

void TestEditorRuns::startHeld() const
{
  const QDialog* const shown = this->dialog();
  fillIn(*shown, this->path("out"));
  this->holdNext();
  QTest::mouseClick(shown->findChild<QPushButton*>("start"), Qt::LeftButton);
  this->waitUntilHeld();
}

void TestEditorRuns::startEditor(QProcess& editor) const
{
  this->holdNext();
  editor.setProcessChannelMode(QProcess::ForwardedChannels);
  editor.start(QCoreApplication::applicationFilePath(), { asEditor, this->Scene, this->path("out") });
  QVERIFY(editor.waitForStarted(longestRun));
  this->waitUntilHeld();
}

void TestEditorRuns::openWindow()
{
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->resize(this->windowSize({}));
  this->Window->show();
  activate(*this->Window);
  this->Window->findRuns();
}

QMap<QString, QByteArray> TestEditorRuns::expected() const
{
  if (this->Expected.isEmpty())
  {
    QProcess::execute(
      QString::fromLocal8Bit(qgetenv("DGTK")), { "render", this->Scene, "-o", this->path("line"), "--layers", layer,
                                                 "--size", QString("%1x%2").arg(size[0], size[1]), "--quiet" });
    this->Expected = contents(this->path("line"));
  }
  return this->Expected;
}

void TestEditorRuns::finishes() const
{
  auto* start = this->Window->findChild<QDialog*>("renderDialog")->findChild<QPushButton*>("start");
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(this->expected().size() > 5);
  QVERIFY(contents(this->path("out")) == this->expected());
}

void TestEditorRuns::quittingAsks()
{
  this->prepare();
  this->startHeld();
  clickIn("runningBox", "stay");
  QVERIFY(!this->Window->close());
  QVERIFY(this->Window->isVisible());
  QCOMPARE(livingRuns().size(), 1);

  clickIn("runningBox", "goOn");
  QVERIFY(this->Window->close());
  this->Window.reset();
  QCOMPARE(livingRuns().size(), 1);
  this->openWindow();
  QVERIFY(!this->dialog()->findChild<QPushButton*>("start")->isEnabled());
  QCOMPARE(this->dialog()->findChild<QLineEdit*>("folder")->text(), this->path("out"));

  clickIn("runningBox", "stop");
  QVERIFY(this->Window->close());
  letGo();
  this->Window.reset(); // waits for the run
  QVERIFY(livingRuns().isEmpty());
  QVERIFY(!QFile::exists(this->path("out/manifest.json")));
  const int kept = contents(this->path("out")).size();
  this->openWindow();
  QVERIFY(this->Window->openFile(this->Scene));
  const QDialog* const shown = this->dialog();
  shown->findChild<QLineEdit*>("folder")->setText(this->path("out"));
  QVERIFY(shown->findChild<QCheckBox*>("resume")->isChecked());
  QVERIFY(contents(this->path("out")).size() == kept);
  QTest::mouseClick(shown->findChild<QPushButton*>("start"), Qt::LeftButton);
  this->finishes();
  QVERIFY2(this->Window->close(), "nothing is asked when nothing is rendered");
}

void TestEditorRuns::theQuestionGoesWithTheRun()
{
  this->prepare();
  this->startHeld();
  QString first;
  QString last;
  answer<QMessageBox>("runningBox",
    [&](QMessageBox& box)
    {
      first = box.text();
      for (int i = 0; i < 1000 && box.text() == first; ++i) // a little at a time, so that it is not over unseen
      {
        sendAll(SIGCONT);
        QTest::qWait(10);
        sendAll(SIGSTOP);
        QTest::qWait(settle);
      }
      last = box.text();
      letGo();
      QTRY_VERIFY(!box.isVisible());
    });
  QVERIFY2(!this->Window->close(), "how the run has ended is to be seen");
  QVERIFY(this->Window->isVisible());
  QVERIFY2(last != first, qPrintable(last)); // it has counted on
  this->finishes();
  QVERIFY2(this->Window->close(), "nothing is asked any more");
}

void TestEditorRuns::aRunOutlivesItsEditor_data()
{
  QTest::addColumn<int>("end");
  QTest::newRow("kill") << SIGKILL;
  QTest::newRow("terminate") << SIGTERM;
  QTest::newRow("log out") << SIGHUP;
}

void TestEditorRuns::aRunOutlivesItsEditor()
{
  QFETCH(int, end);
  this->prepare(false);
  QProcess editor;
  this->startEditor(editor);
  ::kill(pid_t(editor.processId()), end);
  QVERIFY(editor.waitForFinished(longestRun));
  QCOMPARE(livingRuns().size(), 1);
  const pid_t run = livingRuns().first();
  QVERIFY2(::getsid(run) == run, "of a session of its own");
  QVERIFY(::kill(run, SIGHUP) == 0); // of that session, too

  this->openWindow();
  auto* text = this->Window->findChild<QPushButton*>("renderStatusText");
  QVERIFY2(text->isVisible() && text->text().startsWith("Rendering"), qPrintable(text->text()));
  const auto* label = this->dialog()->findChild<QLabel*>("status");
  QTRY_VERIFY2(label->text().startsWith("Pictures: "), qPrintable(label->text()));
  if (end != SIGKILL)
  {
    letGo(); // what was sent to it meanwhile arrives now
    this->finishes();
    return;
  }
  QTest::mouseClick(this->dialog()->findChild<QPushButton*>("cancel"), Qt::LeftButton);
  letGo();
  auto* start = this->dialog()->findChild<QPushButton*>("start");
  QTRY_VERIFY(start->isEnabled());
  QVERIFY2(label->text().startsWith("Stopped."), qPrintable(label->text()));
  QVERIFY(!QFile::exists(this->path("out/manifest.json")));
  QTest::mouseClick(start, Qt::LeftButton); // without its scene: as it was begun
  this->finishes();
}

void TestEditorRuns::aKilledRunGoesOn_data()
{
  QTest::addColumn<bool>("editorToo");
  QTest::addColumn<bool>("entered");
  QTest::newRow("the run") << false << true;
  QTest::newRow("both") << true << true;
  // A file has its name before its entry.
  QTest::newRow("before an entry") << false << false;
}

void TestEditorRuns::aKilledRunGoesOn()
{
  QFETCH(bool, editorToo);
  QFETCH(bool, entered);
  this->prepare();
  if (editorToo)
  {
    QProcess editor;
    this->startEditor(editor);
    ::kill(pid_t(editor.processId()), SIGKILL);
    QVERIFY(editor.waitForFinished(longestRun));
    ::kill(livingRuns().first(), SIGKILL);
    QTRY_VERIFY(livingRuns().isEmpty());
    this->openWindow();
    const QString log = this->Window->findChild<QPlainTextEdit*>("log")->toPlainText();
    QVERIFY2(log.contains(this->path("out") + " was interrupted ("), qPrintable(log));
    QVERIFY(this->Window->openFile(this->Scene));
    this->dialog()->findChild<QLineEdit*>("folder")->setText(this->path("out"));
  }
  else
  {
    this->startHeld();
    ::kill(livingRuns().first(), SIGKILL);
    QTRY_VERIFY(this->dialog()->findChild<QPushButton*>("start")->isEnabled());
  }
  const QString said = this->dialog()->findChild<QLabel*>("status")->text();
  QVERIFY2(said.contains("Start goes on"), qPrintable(said));
  QVERIFY(this->dialog()->findChild<QCheckBox*>("resume")->isChecked());
  const QFile first(this->path("out/") + firstPicture);
  QVERIFY(first.exists());
  if (!entered)
  {
    dropEntry(this->path("out/.dgtk-journal"), firstPicture);
  }
  const QDateTime made = QFileInfo(first).lastModified();
  QTest::mouseClick(this->dialog()->findChild<QPushButton*>("start"), Qt::LeftButton);
  this->finishes();
  QCOMPARE(QFileInfo(first).lastModified() == made, entered); // kept
}

void TestEditorRuns::anEndIsToldAtTheNextStart()
{
  this->prepare();
  this->startHeld();
  clickIn("runningBox", "goOn");
  QVERIFY(this->Window->close());
  this->Window.reset();
  letGo();
  QTRY_VERIFY(livingRuns().isEmpty());
  for (const bool told : { true, false })
  {
    this->openWindow();
    const QString log = this->Window->findChild<QPlainTextEdit*>("log")->toPlainText();
    QVERIFY2(log.contains("Rendered meanwhile: ") == told, qPrintable(log));
    QCOMPARE(this->Window->findChild<QWidget*>("renderStatus")->isVisible(), told);
  }
  QVERIFY(contents(this->path("out")) == this->expected());
}

void TestEditorRuns::unfinishedRunsAreNotReplacedUnasked()
{
  this->prepare();
  this->startHeld();
  ::kill(livingRuns().first(), SIGKILL);
  auto* start = this->dialog()->findChild<QPushButton*>("start");
  QTRY_VERIFY(start->isEnabled());
  const QMap<QString, QByteArray> kept = contents(this->path("out"));
  auto* resume = this->dialog()->findChild<QCheckBox*>("resume");
  resume->setChecked(false);
  answer<QMessageBox>("unfinishedRunBox", [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
  QTest::mouseClick(start, Qt::LeftButton);
  QVERIFY(start->isEnabled());
  QVERIFY(contents(this->path("out")) == kept);
  QTRY_VERIFY(this->dialog()->findChild<QLineEdit*>("folder")->hasFocus());
  clickIn("unfinishedRunBox", "goOn");
  QTest::mouseClick(start, Qt::LeftButton);
  this->finishes();

  // Of another request: what it made goes, by name.
  this->dialog()->findChild<QCheckBox*>("layer.normal")->setChecked(true);
  clickIn("replaceDatasetBox", "replace");
  this->holdNext();
  QTest::mouseClick(start, Qt::LeftButton);
  this->waitUntilHeld();
  ::kill(livingRuns().first(), SIGKILL);
  QTRY_VERIFY(start->isEnabled());
  resume->setChecked(false);
  this->dialog()->findChild<QCheckBox*>("layer.normal")->setChecked(false);
  clickIn("unfinishedRunBox", "replace");
  QTest::mouseClick(start, Qt::LeftButton);
  this->finishes();
}

void TestEditorRuns::aChangedSceneIsAskedAbout()
{
  this->prepare();
  this->startHeld();
  ::kill(livingRuns().first(), SIGKILL);
  auto* start = this->dialog()->findChild<QPushButton*>("start");
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(this->dialog()->findChild<QCheckBox*>("resume")->isChecked());
  this->dialog()->hide();
  activate(*this->Window);
  this->select("house");
  this->type("position.1", "0.5");
  QString asked;
  answer<QMessageBox>("unfinishedRunBox",
    [&asked](QMessageBox& box)
    {
      asked = box.text();
      box.findChild<QPushButton*>("goOn")->click();
    });
  activate(*this->dialog());
  QTest::mouseClick(start, Qt::LeftButton);
  QVERIFY2(asked.contains("before it was changed"), qPrintable(asked));
  this->finishes(); // with the scene as it was
}

void TestEditorRuns::theStatusBarShowsTheRun()
{
  this->prepare();
  auto* text = this->Window->findChild<QPushButton*>("renderStatusText");
  QVERIFY(!text->isVisible());
  this->startHeld();
  QDialog* const shown = this->dialog();
  shown->close();
  activate(*this->Window);
  QTRY_VERIFY2(text->text().contains(" %"), qPrintable(text->text()));
  QVERIFY(text->isVisible());
  QTest::mouseClick(text, Qt::LeftButton);
  QVERIFY(shown->isVisible());
  shown->close();
  letGo();
  QTRY_COMPARE(text->text(), QString("Rendering is done"));
  QVERIFY(text->isVisible());
  const QString log = this->Window->findChild<QPlainTextEdit*>("log")->toPlainText();
  QVERIFY2(log.contains(" files in " + this->path("out")), qPrintable(log));
  activate(*this->Window);
  QTest::mouseClick(text, Qt::LeftButton);
  QVERIFY(shown->isVisible());
  QVERIFY2(!text->isVisible(), "somebody has looked");
  this->finishes();
}

/// Once in the dialog, once in the log; the status bar has it where the dialog is closed.
void TestEditorRuns::aRefusalIsShownOnce()
{
  this->prepare();
  const QDialog* const shown = this->dialog();
  fillIn(*shown, this->path("out"));
  shown->findChild<QCheckBox*>("layer.matting")->setChecked(true);
  auto* matte = shown->findChild<QLineEdit*>("matte");
  matte->setText("nobody");
  matte->setModified(true);
  auto* start = shown->findChild<QPushButton*>("start");
  QTest::mouseClick(start, Qt::LeftButton);
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(QApplication::activeModalWidget() == nullptr);
  const QString said = shown->findChild<QLabel*>("status")->text();
  QVERIFY2(said.startsWith("matte: ") && said.contains("nobody"), qPrintable(said));
  QVERIFY2(!said.contains("--") && !said.contains("dgtk"), qPrintable(said));
  const QStringList log = this->Window->findChild<QPlainTextEdit*>("log")->toPlainText().split('\n');
  QCOMPARE(log.filter("nobody").size(), 2); // the command, the answer
  QVERIFY(!this->Window->findChild<QWidget*>("renderStatus")->isVisible());
}

DGTK_EDITOR_TEST(TestEditorRuns);
static const EditorTestRow rowOfEditor(asEditor, beEditor);
