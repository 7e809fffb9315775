// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorFiles.h"
#include "TestEditorSupport.h"

#include "dgtkError.h"
#include "dgtkMainWindow.h"
#include "dgtkModelReader.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QFileDialog>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>

#include <ctime>
#include <map>
#include <set>
#include <utility>

using dgtk::test::sourceFile;

namespace
{
constexpr int longestEventMs = 200; // of the window's thread
constexpr int fewOfAFormat = 5;     // models, where there is no time for all
constexpr int side = 450;           // vertices of the large model's side

/// Milliseconds that this thread has computed.
double computed()
{
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) * 1e3 + double(now.tv_nsec) / 1e6;
}

/// A wavy square of 2 (side - 1)^2 triangles.
QByteArray largeObj()
{
  QByteArray text;
  for (int i = 0; i < side * side; ++i)
  {
    text +=
      "v " + QByteArray::number(i % side) + ' ' + QByteArray::number(i % 7) + ' ' + QByteArray::number(i / side) + '\n';
  }
  for (int i = 0; i + side + 1 < side * side; ++i)
  {
    const QByteArray a = QByteArray::number(i + 1);
    const QByteArray b = QByteArray::number(i + 2);
    const QByteArray c = QByteArray::number(i + side + 1);
    const QByteArray d = QByteArray::number(i + side + 2);
    text += i % side == side - 1 ? QByteArray() : "f " + a + ' ' + c + ' ' + d + ' ' + b + '\n';
  }
  return text;
}
} // namespace

QString TestEditorFiles::model(const char* name)
{
  return QString::fromStdString(sourceFile(std::string("Data/Models/") + name));
}

QByteArray TestEditorFiles::contentsOf(const QString& path)
{
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

QString TestEditorFiles::write(const char* name, const QByteArray& contents) const
{
  QFile file(this->path(name));
  return file.open(QIODevice::WriteOnly) && file.write(contents) == contents.size() ? file.fileName() : QString();
}

QString TestEditorFiles::import(const QString& path)
{
  QString said;
  QTimer looker;
  connect(&looker, &QTimer::timeout, &looker,
    [&said]
    {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box != nullptr && box->objectName() == "errorBox")
      {
        said += box->text();
        box->accept();
      }
    });
  looker.start(5);
  const bool done = this->Window->importFile(path);
  if (done != said.isEmpty())
  {
    QTest::qFail(qPrintable("refused without a message, or the other way round: " + path), __FILE__, __LINE__);
  }
  return said;
}

QString TestEditorFiles::importChecked(const QString& path)
{
  dgtk::SceneDocument& document = this->Window->document();
  const std::string before = document.json();
  const std::size_t objects = document.scene().objects.size();
  const std::size_t models = document.models().size();
  QString said = this->import(path);
  if (!said.isEmpty())
  {
    const bool same = document.json() == before && document.models().size() == models;
    const bool named = said.contains(QFileInfo(path).fileName()) && !said.contains('\n');
    if (!same || !named)
    {
      QTest::qFail(qPrintable("not as before, or no line that names the file: " + said), __FILE__, __LINE__);
    }
  }
  else if (document.scene().objects.size() != objects + 1)
  {
    QTest::qFail(qPrintable("no object: " + path), __FILE__, __LINE__);
  }
  return said;
}

void TestEditorFiles::samplesAreImportedOrRefused()
{
  const QString folder = QString::fromStdString(dgtk::test::extraModels());
  if (folder.isEmpty())
  {
    QSKIP("further models are not part of the source: set DGTK_EXTRA_MODELS");
  }
  QStringList patterns;
  for (const dgtk::ReaderInfo& reader : dgtk::modelReaders())
  {
    for (const std::string& extension : reader.extensions)
    {
      patterns << "*." + QString::fromStdString(extension);
    }
  }
  const bool all = qEnvironmentVariableIsSet("DGTK_TEST_WHOLE");
  std::map<QString, std::set<std::pair<qint64, QString>>> formats; // small models first
  for (QDirIterator at(folder, patterns, QDir::Files, QDirIterator::Subdirectories); at.hasNext();)
  {
    const QFileInfo file(at.next());
    formats[file.suffix().toLower()].emplace(file.size(), file.filePath());
  }
  QStringList paths;
  for (const auto& [suffix, models] : formats)
  {
    int left = all ? int(models.size()) : fewOfAFormat;
    for (auto at = models.begin(); at != models.end() && left > 0; ++at, --left)
    {
      paths << at->second;
    }
  }
  int imported = 0;
  QStringList refused;
  for (const QString& path : paths)
  {
    QString expected;
    try
    {
      expected = dgtk::readModel(path.toStdString())->triangles.empty() ? "has no surfaces: nothing was added." : "";
    }
    catch (const dgtk::InputError& error)
    {
      const QString whole = error.what(); // the document names the folder in its own way
      expected = whole.mid(std::max(0, whole.lastIndexOf(QFileInfo(path).fileName())));
    }
    const QString said = this->importChecked(path);
    QVERIFY2(!said.contains("object '"), qPrintable(said));
    QVERIFY2(said.isEmpty() == expected.isEmpty() && (said.isEmpty() || said.endsWith(expected)),
      qPrintable(path + QString(" said: %1 expected: %2").arg(said, expected)));
    imported += said.isEmpty() ? 1 : 0;
    if (!said.isEmpty())
    {
      refused << QFileInfo(path).fileName();
    }
  }
  QVERIFY2(imported >= (all ? 30 : 12), qPrintable(QString::number(imported)));
  QVERIFY2(refused.contains("empty.3ds"), qPrintable(refused.join(' ')));
  while (this->Window->document().canUndo())
  {
    this->action("undo")->trigger();
  }
  QVERIFY(this->Window->document().scene().objects.empty());
}

void TestEditorFiles::damagedFilesAreRefused()
{
  QVERIFY(this->import(model("crate.ac")).isEmpty());
  const QByteArray garbage = QByteArray("\x00\xff\x01 no model {[(<", 18).repeated(40);
  for (const dgtk::ReaderInfo& reader : dgtk::modelReaders())
  {
    for (const std::string& extension : reader.extensions)
    {
      const QByteArray name = QByteArray("damaged.") + extension.c_str();
      QVERIFY2(!this->importChecked(this->path("missing") + name).isEmpty(), name);
      QVERIFY2(!this->importChecked(this->write(name, {})).isEmpty(), name);
      QVERIFY2(!this->importChecked(this->write(name, garbage)).isEmpty(), name);
    }
  }
}

void TestEditorFiles::filesThatEndEarlyAreRefused()
{
  QVERIFY(this->import(model("crate.ac")).isEmpty());
  auto* log = this->Window->findChild<QPlainTextEdit*>("log");
  for (const char* own :
    { "house.ac", "terrain.acc", "creature.md2", "chair.3ds", "head.pov", "column.obj", "windmill.gltf" })
  {
    const QByteArray whole = contentsOf(model(own));
    const QByteArray name = "cut." + QFileInfo(own).suffix().toLatin1();
    for (const int part : { 1, 40, 66, 90 })
    {
      log->clear();
      const QString said = this->importChecked(this->write(name, whole.left(whole.size() * part / 100)));
      // What is left of a list of lines is a model. A 3DS file's last chunks are read as far as they are there.
      const bool warned = name == "cut.obj" || (name == "cut.3ds" && log->toPlainText().contains("longer than"));
      QVERIFY2(!said.isEmpty() || warned, qPrintable(own + QString(" %1").arg(part)));
    }
  }
}

void TestEditorFiles::useImporter(const QByteArray& line) const
{
  static int number = 0; // of another name each, or the one that runs already is asked
  QFile script(this->write(("importer" + QByteArray::number(++number)).constData(), "#!/bin/sh\n" + line + '\n'));
  script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  qputenv("DGTK_IMPORT", script.fileName().toLocal8Bit());
}

void TestEditorFiles::useWaitingImporter(const QByteArray& line) const
{
  QFile::remove(this->path("go"));
  this->useImporter("until [ -e '" + this->path("go").toLocal8Bit() + "' ]; do /bin/sleep 0.02; done\n" + line);
}

void TestEditorFiles::letImporterGo() const
{
  this->write("go", "");
  qunsetenv("DGTK_IMPORT");
}

void TestEditorFiles::anImporterThatCrashesIsAMessage()
{
  for (const char* signal : { "SEGV", "ABRT", "KILL" })
  {
    this->useImporter(QByteArray("kill -") + signal + " $$");
    for (const char* name : { "a.fbx", "a.dae", "a.glb" })
    {
      const QString said = this->importChecked(this->write(name, "contents"));
      QVERIFY2(said.contains("ended abnormally") || said.contains("is damaged"), qPrintable(said));
    }
  }
  qunsetenv("DGTK_IMPORT");
  QVERIFY(this->import(model("windmill.gltf")).isEmpty());
}

void TestEditorFiles::readingDoesNotHoldTheWindow()
{
  const QString file = this->write("large.obj", largeObj());
  double last = computed();
  double longest = 0;
  int beats = 0;
  const auto* progress = this->Window->findChild<QWidget*>("backgroundWork");
  QVERIFY(progress->isHidden());
  bool isShown = false;
  QTimer heart;
  connect(&heart, &QTimer::timeout, &heart,
    [&]
    {
      const double now = computed();
      // While a file is read no other can be opened.
      const bool reading = !this->action("open")->isEnabled();
      beats += reading ? 1 : 0;
      isShown = isShown || (reading && progress->isVisible());
      longest = reading ? std::max(longest, now - last) : longest;
      last = now;
    });
  heart.start(1);
  QVERIFY(this->Window->importFile(file));
  QVERIFY2(beats > 20, qPrintable(QString::number(beats)));
  qInfo("%d beats while %d triangles were read; the longest event took %.0f ms", beats, 2 * (side - 1) * (side - 1),
    longest);
  QVERIFY(longest < patience() * longestEventMs);
  QVERIFY(isShown && progress->isHidden());
  QVERIFY(this->action("open")->isEnabled());
}

void TestEditorFiles::readingIsCancelled()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  const std::string before = document.json();
  this->useWaitingImporter();
  const QString file = this->write("slow.dae", "contents");
  auto* cancel = this->Window->findChild<QPushButton*>("backgroundCancel");
  QTimer clicker;
  bool second = true;
  connect(&clicker, &QTimer::timeout, &clicker,
    [&]
    {
      if (cancel->isVisible())
      {
        second = this->Window->importFile(model("crate.ac"));
        QTest::mouseClick(cancel, Qt::LeftButton);
        clicker.stop();
      }
    });
  clicker.start(10);
  const bool imported = this->Window->importFile(file);
  this->letImporterGo();
  QVERIFY(!imported);
  QVERIFY2(!second, "one file at a time");
  QVERIFY(!cancel->isVisible());
  QCOMPARE(document.json(), before);
  QVERIFY(this->import(model("crate.ac")).isEmpty());
  QCOMPARE(document.undoText(), std::string("Import crate.ac"));
}

void TestEditorFiles::warningsAreNotedOnce()
{
  auto* log = this->Window->findChild<QPlainTextEdit*>("log");
  const QByteArray crate =
    R"({ "model": ")" + model("crate.ac").toUtf8() + R"(", "materials": { "*": { "texture": "gone.png" } } })";
  QVERIFY(this->Window->openFile(this->write("scene %2.json", R"({ "objects": [)" + crate + ", " + crate + "] }")));
  const QString line = "texture 'gone.png': not found";
  QCOMPARE(log->toPlainText().count(line), 1);
  this->select("crate-1");
  this->action("duplicate")->trigger();
  this->action("undo")->trigger();
  QCOMPARE(log->toPlainText().count(line), 1);
  QVERIFY(this->Window->openFile(this->path("scene %2.json")));
  QCOMPARE(log->toPlainText().count(line), 2); // it was read again
  QVERIFY2(log->toPlainText().contains("Opened scene %2.json: 2 objects"), qPrintable(log->toPlainText()));

  log->clear();
  const QByteArray whole = contentsOf(model("column.obj"));
  QVERIFY(this->Window->importFile(this->write("cut.obj", whole.left(whole.size() * 9 / 10))));
  QStringList lines = log->toPlainText().split('\n');
  QVERIFY(lines.first().startsWith("Warning: cut.obj: "));
  QCOMPARE(lines.removeDuplicates(), 0);
}

void TestEditorFiles::whenReading(QTimer& timer, const std::function<void(QPushButton&)>& act) const
{
  auto* cancel = this->Window->findChild<QPushButton*>("backgroundCancel");
  connect(&timer, &QTimer::timeout, &timer,
    [&timer, cancel, act]
    {
      if (cancel->isVisible())
      {
        timer.stop();
        act(*cancel);
      }
    });
  timer.start(10);
}

void TestEditorFiles::aCancelledExportWritesNothing()
{
  QVERIFY(this->Window->importFile(model("windmill.gltf")));
  const QString file = this->write("scene.pov", "what was there");
  this->useWaitingImporter("exec " + QCoreApplication::applicationDirPath().toLocal8Bit() + "/dgtk-import \"$@\"");
  QTimer clicker;
  this->whenReading(clicker, [](QPushButton& cancel) { QTest::mouseClick(&cancel, Qt::LeftButton); });
  answer<QMessageBox>("replaceBox", [](QMessageBox& box) { box.button(QMessageBox::Yes)->click(); });
  this->inFileDialog("exportPov", [&](QFileDialog& dialog) { name(dialog, file); });
  this->letImporterGo();
  QVERIFY(!clicker.isActive());
  this->Window.reset(); // waits for the thread
  QCOMPARE(contentsOf(file), QByteArray("what was there"));
}

void TestEditorFiles::theWindowClosesWhileItReads()
{
  this->useWaitingImporter();
  QTimer closer;
  connect(&closer, &QTimer::timeout, &closer,
    [&]
    {
      if (!this->action("open")->isEnabled())
      {
        closer.stop();
        QVERIFY(this->Window->close());
      }
    });
  closer.start(10);
  const bool imported = this->Window->importFile(this->write("slow.dae", "contents"));
  this->letImporterGo();
  QVERIFY(!imported);
  QVERIFY(!this->Window->isVisible());
  QVERIFY(this->Window->document().scene().objects.empty());
}

void TestEditorFiles::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  this->Window->resize(1280, 860);
  QVERIFY(this->Window->openFile(demo()));
  this->useWaitingImporter();
  QTimer clicker;
  this->whenReading(clicker,
    [&](QPushButton& cancel)
    {
      QTest::qWait(settle);
      const QPixmap all = this->Window->grab();
      const int height = 90;
      all.copy(0, all.height() - height, all.width(), height).save(folder + "/editor_reading.png");
      cancel.click();
    });
  this->Window->importFile(this->write("cathedral.dae", "contents"));
  this->letImporterGo();
}

DGTK_EDITOR_TEST(TestEditorFiles);
