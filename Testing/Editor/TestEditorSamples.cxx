// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorSamples.h"
#include "TestEditorSupport.h"

#include "dgtkSceneDescription.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeWidget>

#include <memory>

using dgtk::test::sourceFile;

namespace
{
QByteArray model(const char* name)
{
  return QByteArray::fromStdString("\"model\": \"" + sourceFile(std::string("Data/Models/") + name) + '"');
}

/// Balls above a floor; as many as a parameter says.
QByteArray balls(const QByteArray& camera = R"(, "lookAt": [0, 0, 0])")
{
  return R"({ "seed": 5, "parameters": { "n": { "integer": [1, 6] } }, "objects": [ { "name": "floor", )" +
         model("floor.ac") +
         R"( }, { "name": "ball", "count": "$n", "position": { "inBox": [[-2, 1, -2], [2, 2, 2]] }, )" +
         model("ball.ac") + R"( } ], "cameras": [ { "name": "c", "eye": { "inBox": [[-1, 5, 8], [1, 6, 9]] })" +
         camera + " } ] }";
}

constexpr const char* neverSeen =
  R"(, "lookAt": [0, 100, 0], "require": { "visible": { "floor": 0.9 }, "attempts": %1, "pixels": 640 })";
} // namespace

QString TestEditorSamples::write(const char* name, const QByteArray& scene) const
{
  QFile file(this->path(name));
  return file.open(QIODevice::WriteOnly) && file.write(scene) == scene.size() ? file.fileName() : QString();
}

QDialog* TestEditorSamples::opened(const QString& scene) const
{
  answer<QMessageBox>(
    "randomBox", [](QMessageBox& box) { QTest::mouseClick(box.findChild<QPushButton*>("sample"), Qt::LeftButton); });
  this->Window->openFile(scene);
  auto* const dialog = this->Window->findChild<QDialog*>("sampleDialog");
  activate(*dialog);
  return dialog;
}

QString TestEditorSamples::status(const char* name) const
{
  return this->Window->findChild<QDialog*>("sampleDialog")->findChild<QLabel*>(name)->text();
}

void TestEditorSamples::waitFor(const QString& beginning) const
{
  QTRY_VERIFY(!this->status().startsWith("Drawing"));
  QVERIFY2(this->status().startsWith(beginning), qPrintable(this->status()));
}

void TestEditorSamples::click(const char* button) const
{
  auto* const at = this->Window->findChild<QDialog*>("sampleDialog")->findChild<QPushButton*>(button);
  QVERIFY2(at->isEnabled() && at->isVisible(), button);
  QTest::mouseClick(at, Qt::LeftButton);
}

QByteArray TestEditorSamples::shown() const { return QByteArray::fromStdString(this->Window->document().json()); }

QByteArray TestEditorSamples::sampled(const QString& scene, int number, const QString& folder) const
{
  const QString name = QString("%1.json").arg(number, 6, 10, QChar('0'));
  run({ "sample", scene, "-o", folder, "--samples", QString::number(number), "--replace", "--quiet" });
  QFile file(folder + '/' + name);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void TestEditorSamples::samplesAreThoseOfTheCommandLine()
{
  const QString scene = this->write("balls.json", balls());
  const QDialog* const dialog = this->opened(scene);
  this->waitFor("Sample 0: ");
  dgtk::SceneDocument& document = this->Window->document();
  QVERIFY(document.modified());
  QVERIFY(document.path().empty());
  QCOMPARE(dialog->findChild<QDoubleSpinBox*>("seed")->value(), 5.0);
  for (const int number : { 0, 1, 2 })
  {
    this->waitFor(QString("Sample %1: ").arg(number));
    dgtk::SceneDescription written = document.scene();
    QCOMPARE(QByteArray::fromStdString(toJson(written, this->Folder.path("line"))),
      this->sampled(scene, number, this->path("line")));
    auto* const values = dialog->findChild<QTreeWidget*>("values");
    const QList<QTreeWidgetItem*> rows = values->findItems("parameters/n", Qt::MatchExactly);
    QCOMPARE(rows.size(), 1);
    QCOMPARE(rows[0]->text(1).toULong(), document.scene().objects.size() - 1);
    QCOMPARE(values->findItems("cameras/c/eye", Qt::MatchExactly).size(), 1);
    this->click("next");
  }
  this->waitFor("Sample 3: ");
  this->click("previous");
  this->waitFor("Sample 2: ");
  QVERIFY(!document.canUndo());
}

void TestEditorSamples::theKeyboardChoosesSamples()
{
  const QDialog* const dialog = this->opened(this->write("keys.json", balls()));
  this->waitFor("Sample 0: ");
  auto* const number = dialog->findChild<QSpinBox*>("number");
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_N, Qt::AltModifier);
  QTRY_VERIFY(number->hasFocus());
  QTest::keyClick(number, Qt::Key_Up);
  this->waitFor("Sample 1: ");
  QTest::keyClick(number, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(number, "700");
  QTest::qWait(settle);
  QVERIFY2(this->status().startsWith("Sample 1: "), "nothing is drawn while a number is typed");
  QTest::keyClick(number, Qt::Key_Return);
  this->waitFor("Sample 700: ");
  QVERIFY(dialog->isVisible());
  const QByteArray own = this->shown();
  QTest::keyClick(number, Qt::Key_S, Qt::AltModifier);
  auto* const seed = dialog->findChild<QDoubleSpinBox*>("seed");
  QTRY_VERIFY(seed->hasFocus());
  QTest::keyClick(seed, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(seed, "9007199254740991");
  QTest::keyClick(seed, Qt::Key_Return);
  QTRY_VERIFY(this->shown() != own);
  this->waitFor("Sample 700: ");
  QTest::keyClick(seed, Qt::Key_Escape);
  QTRY_VERIFY(!dialog->isVisible());
}

void TestEditorSamples::aTypedNumberEndsWithTheWindow()
{
  const QDialog* const dialog = this->opened(this->write("typed.json", balls()));
  this->waitFor("Sample 0: ");
  auto* const number = dialog->findChild<QSpinBox*>("number");
  number->setFocus();
  QTest::keyClicks(number, "7");
  this->Window.reset(); // the field loses the focus while the dialog goes
}

void TestEditorSamples::whatIsRefusedAndLeftOutIsSaid()
{
  const QByteArray never = QByteArray(neverSeen).replace("%1", "2");
  const QDialog* dialog = this->opened(this->write("refused.json", balls(never)));
  this->waitFor("Sample 0 is refused: cameras/c/require: ");
  auto* const notes = dialog->findChild<QPlainTextEdit*>("notes");
  QVERIFY2(notes->toPlainText().endsWith("attempts: 2"), qPrintable(notes->toPlainText()));
  QVERIFY(this->Window->document().scene().objects.empty());
  QVERIFY(!dialog->findChild<QPushButton*>("keep")->isEnabled());
  QVERIFY(dialog->findChild<QTreeWidget*>("values")->topLevelItemCount() > 0);

  const QByteArray omitted = QByteArray(never).replace("\"attempts\"", R"("otherwise": "omit", "attempts")");
  this->opened(this->write("omitted %2.json", balls(omitted)));
  this->waitFor("Sample 0: ");
  QVERIFY2(this->status().endsWith(" 0 cameras; 1 left out"), qPrintable(this->status()));
  QVERIFY(notes->toPlainText().startsWith("cameras/c/require: "));

  const QByteArray wrong = balls().replace("[1, 6]", "[6, 1]");
  this->write("omitted %2.json", wrong);
  this->click("draw");
  this->waitFor(this->path("omitted %2.json"));
  QVERIFY2(this->status().endsWith(". The views show sample 0."), qPrintable(this->status()));
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
  this->opened(this->write("wrong.json", wrong));
  this->waitFor(this->path("wrong.json"));
  QVERIFY2(this->status().contains("parameters.n"), qPrintable(this->status()));
  QVERIFY2(!this->status().contains("is refused"), "that is a fault of the file, not of the sample");
}

void TestEditorSamples::aSampleIsStopped()
{
  const QString scene = this->write("slow.json", balls(QByteArray(neverSeen).replace("%1", "10000")));
  const QDialog* const dialog = this->opened(scene);
  auto* const application = dynamic_cast<TimedApplication*>(qApp);
  application->restart();
  QTest::qWait(4 * settle); // the window answers
  QVERIFY2(application->longest() < 200 * patience(), qPrintable(application->what()));
  QCOMPARE(this->status(), QString("Drawing sample 0 ..."));
  this->click("stop");
  QCOMPARE(this->status(), QString("Stopped."));
  QVERIFY(!dialog->findChild<QPushButton*>("stop")->isVisible());
  // The thread is free for another one.
  this->opened(this->write("quick.json", balls()));
  this->waitFor("Sample 0: ");
}

void TestEditorSamples::unsavedWorkIsAskedAbout()
{
  const auto answerUnsaved = [](QMessageBox::StandardButton choice)
  { answer<QMessageBox>("unsavedBox", [choice](QMessageBox& box) { box.button(choice)->click(); }); };
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/crate.ac"))));
  const QByteArray own = this->shown();
  answerUnsaved(QMessageBox::Cancel);
  const QString scene = this->write("balls.json", balls());
  QVERIFY(!this->Window->openFile(scene));
  QCOMPARE(this->shown(), own);
  answerUnsaved(QMessageBox::Discard); // once, not again for the sample
  this->opened(scene);
  this->waitFor("Sample 0: ");
  this->click("next"); // as it was drawn: it can be drawn again
  this->waitFor("Sample 1: ");

  this->Window->document().edit("Move", [](dgtk::SceneDescription& all) { all.objects[0].position.value.x() = 7; });
  const QByteArray edited = this->shown();
  answerUnsaved(QMessageBox::Cancel);
  this->click("next");
  QTest::qWait(settle);
  QCOMPARE(this->shown(), edited);
  QCOMPARE(this->Window->findChild<QDialog*>("sampleDialog")->findChild<QSpinBox*>("number")->value(), 1);
  answerUnsaved(QMessageBox::Discard);
  this->click("next");
  this->waitFor("Sample 2: ");
  QVERIFY(this->shown() != edited);
}

void TestEditorSamples::whatIsGivenUpIsGivenUpForOneSample()
{
  const QString scene = this->write("balls.json", balls());
  const QString never = this->write("never.json", balls(QByteArray(neverSeen).replace("%1", "2")));
  const auto discard = []
  { answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); }); };
  const auto giveUpInVain = [&]
  {
    discard();
    answer<QMessageBox>("randomBox", [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
    QVERIFY(!this->Window->openFile(scene));
  };
  const auto isAskedAbout = [&](const std::function<void()>& what)
  {
    const auto asked = std::make_shared<bool>(false);
    answer<QMessageBox>("unsavedBox",
      [asked](QMessageBox& box)
      {
        *asked = true;
        box.button(QMessageBox::Cancel)->click();
      });
    what();
    return *asked && this->status() == "Stopped.";
  };
  const auto sample = [&]
  {
    answer<QFileDialog>({},
      [&](QFileDialog& files)
      {
        files.findChild<QLineEdit*>("fileNameEdit")->setText(scene);
        QMetaObject::invokeMethod(&files, "accept");
      });
    this->action("sampleScene")->trigger();
  };
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/crate.ac"))));
  const QByteArray own = this->shown();
  giveUpInVain();
  QVERIFY(isAskedAbout(sample));
  giveUpInVain();
  QVERIFY(isAskedAbout([this] { this->click("draw"); }));
  discard();
  this->opened(never);
  this->waitFor("Sample 0 is refused: ");
  QVERIFY(isAskedAbout(sample));
  QCOMPARE(this->shown(), own);
}

void TestEditorSamples::aSampleIsKept()
{
  const QString scene = this->write("balls.json", balls());
  const QDialog* const dialog = this->opened(scene);
  this->waitFor("Sample 0: ");
  QDir().mkpath(this->path("kept"));
  const QString kept = this->path("kept/first.json");
  answer<QFileDialog>({},
    [&kept](QFileDialog& files)
    {
      files.findChild<QLineEdit*>("fileNameEdit")->setText(kept);
      QMetaObject::invokeMethod(&files, "accept");
    });
  this->click("keep");
  QTRY_VERIFY(QFile::exists(kept));
  QVERIFY(!this->Window->document().modified());
  QVERIFY(!dialog->findChild<QPushButton*>("keep")->isEnabled());
  QFile file(kept);
  QVERIFY(file.open(QIODevice::ReadOnly));
  QCOMPARE(file.readAll(), this->sampled(scene, 0, this->path("line")));
}

void TestEditorSamples::manyAreWritten()
{
  const QString scene = this->write("balls.json", balls());
  const QDialog* const dialog = this->opened(scene);
  this->waitFor("Sample 0: ");
  typeInto(dialog->findChild<QSpinBox*>("first"), "3");
  typeInto(dialog->findChild<QSpinBox*>("last"), "5");
  auto* const folder = dialog->findChild<QLineEdit*>("folder");
  QCOMPARE(folder->text(), this->path("balls_samples"));
  const auto buttons = dialog->findChildren<QPushButton*>();
  const auto browse = std::find_if(
    buttons.begin(), buttons.end(), [](const QPushButton* button) { return button->text() == "Browse ..."; });
  QVERIFY(browse != buttons.end());
  browseFor(*browse, folder, this->path("others"));
  typeInto(folder, this->path("balls_samples"));
  auto* const write = dialog->findChild<QPushButton*>("write");
  this->click("write");
  QTRY_VERIFY(write->isEnabled());
  QVERIFY2(this->status("writerStatus").startsWith("3 scenes in "), qPrintable(this->status("writerStatus")));
  QCOMPARE(run({ "sample", scene, "-o", this->path("line3"), "--samples", "3:5", "--quiet" }), 0);
  QCOMPARE(contents(this->path("balls_samples")), contents(this->path("line3")));
  this->click("write");
  QTRY_VERIFY(write->isEnabled());
  const QString said = this->status("writerStatus");
  QVERIFY2(said.endsWith("; Replace removes them") && !said.contains("--"), qPrintable(said));
  typeInto(dialog->findChild<QSpinBox*>("first"), "5");
  typeInto(folder, this->path("one"));
  this->click("write");
  QTRY_VERIFY(write->isEnabled());
  QVERIFY2(this->status("writerStatus").startsWith("1 scenes in "), qPrintable(this->status("writerStatus")));
  typeInto(dialog->findChild<QSpinBox*>("first"), "6");
  this->click("write");
  QCOMPARE(this->status("writerStatus"), QString("The first number is greater than the last."));
}

void TestEditorSamples::writingIsCancelled()
{
  const QDialog* const dialog = this->opened(this->write("balls.json", balls()));
  this->waitFor("Sample 0: ");
  typeInto(dialog->findChild<QSpinBox*>("last"), "999999");
  const QString folder = this->path("cancelled");
  typeInto(dialog->findChild<QLineEdit*>("folder"), folder);
  this->click("write");
  QTRY_VERIFY(QFile::exists(folder + "/000001.json"));
  this->click("cancel");
  QTRY_VERIFY(dialog->findChild<QPushButton*>("write")->isEnabled());
  QCOMPARE(this->status("writerStatus"), QString("Stopped."));
  QVERIFY(contents(folder)["samples.json"].contains("\"complete\": false"));
  QVERIFY(!QFile::exists(folder + "/999999.json"));
}

void TestEditorSamples::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    QSKIP("DGTK_EDITOR_PICTURES names no folder");
  }
  QDialog* const dialog = this->opened(QString::fromStdString(sourceFile("Data/Recipes/table_tops.json")));
  this->waitFor("Sample 0: ");
  typeInto(dialog->findChild<QSpinBox*>("number"), "3");
  this->waitFor("Sample 3: ");
  dialog->findChild<QLineEdit*>("folder")->setText("table_tops_samples");
  untilQuiet();
  QVERIFY(dialog->grab().save(folder + "/editor_samples.png"));
}

DGTK_EDITOR_TEST(TestEditorSamples);
