// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorTimeLine.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"
#include "dgtkSequenceBar.h"

#include <QAbstractScrollArea>
#include <QAction>
#include <QApplication>
#include <QContextMenuEvent>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QScrollBar>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>

using dgtk::Interpolation;
using dgtk::SceneItem;
using Frames = std::vector<int>;

namespace
{
constexpr int cellWidth = 12;
constexpr int namesWidth = 130;
constexpr int headerHeight = 26;
constexpr int rowHeight = 18;
constexpr int barHeight = 16;
constexpr SceneItem crate{ SceneItem::Kind::Object, 0 };
constexpr SceneItem tree{ SceneItem::Kind::Object, 1 };

std::string model(const char* name) { return dgtk::test::sourceFile(std::string("Data/Models/") + name); }
} // namespace

QWidget* TestEditorTimeLine::cells() const
{
  return this->Window->findChild<QAbstractScrollArea*>("timeLineCells")->viewport();
}

QPoint TestEditorTimeLine::at(int frame, int row, bool bar)
{
  const int y = row < 0 ? headerHeight - 5 : headerHeight + row * rowHeight + (bar ? rowHeight + barHeight / 2 : 9);
  return { namesWidth + frame * cellWidth + cellWidth / 2, y };
}

void TestEditorTimeLine::drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers, bool release) const
{
  QWidget* const cells = this->cells();
  const auto send = [&](QEvent::Type type, const QPoint& at, Qt::MouseButton button, Qt::MouseButtons buttons)
  {
    QMouseEvent event(type, at, cells->mapToGlobal(at), button, buttons, modifiers);
    QApplication::sendEvent(cells, &event);
  };
  send(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
  send(QEvent::MouseMove, (from + to) / 2, Qt::NoButton, Qt::LeftButton);
  send(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton);
  if (release)
  {
    send(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
  }
}

void TestEditorTimeLine::key(Qt::Key key, Qt::KeyboardModifiers modifiers) const
{
  QTest::keyClick(this->cells()->parentWidget(), key, modifiers);
}

void TestEditorTimeLine::choose(const QPoint& where, const char* submenu, const QString& text) const
{
  QTest::mouseClick(this->cells(), Qt::RightButton, {}, where);
  bool found = false;
  QTimer::singleShot(0, this,
    [&]
    {
      QWidget* const popup = QApplication::activePopupWidget();
      QMenu* const menu = *submenu == 0 ? qobject_cast<QMenu*>(popup) : popup->findChild<QMenu*>(submenu);
      this->Checked.clear();
      for (QAction* action : menu->actions())
      {
        this->Checked += action->isChecked() ? action->text().remove('&') + '.' : QString();
        if (action->text().remove('&') == text && action->isEnabled() && menu->isEnabled())
        {
          action->trigger();
          found = true;
        }
      }
      popup->close();
    });
  QContextMenuEvent event(QContextMenuEvent::Mouse, where, this->cells()->mapToGlobal(where));
  QApplication::sendEvent(this->cells(), &event);
  QVERIFY2(found, qPrintable(text));
}

void TestEditorTimeLine::openTwo()
{
  dgtk::SceneDocument& document = this->Window->document();
  document.addModel(model("crate.ac"));
  document.addModel(model("tree.ac"));
  document.edit("keys",
    [](dgtk::SceneDescription& scene)
    {
      dgtk::makeKeyFrame(scene, 0);
      dgtk::setItemPosition(scene, crate, 10, { 10, 0, 0 });
      dgtk::setItemPosition(scene, tree, 10, { 0, 0, 10 });
    });
}

void TestEditorTimeLine::keysOfARowAreDragged()
{
  this->openTwo();
  const dgtk::SceneDescription& scene = this->Window->document().scene();
  const std::string before = this->Window->document().json();
  this->drag(at(10, 0), at(14, 0));
  QCOMPARE(keyFramesOf(scene, crate), (Frames{ 0, 14 }));
  QCOMPARE(keyFramesOf(scene, tree), (Frames{ 0, 10 }));
  QCOMPARE(scene.objects[0].position.at(7).x(), 5.0);
  QCOMPARE(this->Window->findChild<QSpinBox*>("frame")->value(), 14);
  this->drag(at(14, 0), at(20, 0), Qt::ControlModifier);
  QCOMPARE(keyFramesOf(scene, crate), (Frames{ 0, 14, 20 }));
  QCOMPARE(scene.objects[0].position.at(17).x(), 10.0);
  this->drag(at(12, 0), at(30, 0)); // no key is there
  QCOMPARE(keyFramesOf(scene, crate), (Frames{ 0, 14, 20 }));
  QCOMPARE(this->Window->findChild<QSpinBox*>("frame")->value(), 30);
  this->action("undo")->trigger();
  QCOMPARE(keyFramesOf(scene, crate), (Frames{ 0, 14 }));
  this->action("undo")->trigger();
  QCOMPARE(this->Window->document().json(), before);
}

void TestEditorTimeLine::keysOfTheSceneAreDragged()
{
  this->openTwo();
  const dgtk::SceneDescription& scene = this->Window->document().scene();
  const std::string before = this->Window->document().json();
  this->drag(at(10, -1), at(16, -1));
  QCOMPARE(keyFramesOf(scene, crate), (Frames{ 0, 16 }));
  QCOMPARE(keyFramesOf(scene, tree), (Frames{ 0, 16 }));
  this->drag(at(0, -1), at(4, -1), Qt::ControlModifier);
  QCOMPARE(scene.keyFrames(), (Frames{ 0, 4, 16 }));
  QCOMPARE(scene.objects[1].position.at(4).z(), 0.0);
  this->action("undo")->trigger();
  this->action("undo")->trigger();
  QCOMPARE(this->Window->document().json(), before);
  // The numbers above the marks scrub.
  this->drag(QPoint(at(10, -1).x(), 5), QPoint(at(3, -1).x(), 5));
  QCOMPARE(this->Window->findChild<QSpinBox*>("frame")->value(), 3);
  QCOMPARE(this->Window->document().json(), before);
}

void TestEditorTimeLine::escapeLeavesAKeyWhereItIs()
{
  this->openTwo();
  const std::string before = this->Window->document().json();
  this->drag(at(10, 0), at(14, 0), {}, false);
  this->key(Qt::Key_Escape);
  QTest::mouseRelease(this->cells(), Qt::LeftButton, {}, at(14, 0));
  QCOMPARE(this->Window->document().json(), before);
}

void TestEditorTimeLine::aKeyHasAnInterpolation()
{
  this->openTwo();
  dgtk::SceneDocument& document = this->Window->document();
  const std::string before = document.json();
  this->choose(at(0, 0), "keyInterpolation", "Steps");
  QCOMPARE(document.scene().objects[0].position.at(9).x(), 0.0);
  QCOMPARE(document.scene().objects[1].position.at(5).z(), 5.0);
  QVERIFY(QString::fromStdString(document.json()).contains("\"step\""));
  // Kept in the file, and dragged along.
  this->drag(at(0, 0), at(2, 0));
  QVERIFY(this->Window->saveFile(this->path("steps.json")));
  dgtk::SceneDocument again;
  again.open(this->path("steps.json").toStdString());
  QVERIFY(again.scene().objects[0].position.keys == document.scene().objects[0].position.keys);
  QCOMPARE(keyInterpolationOf(again.scene(), crate, 2)->kind, Interpolation::Step);
  this->choose(at(2, 0), "keyInterpolation", "As its other keys");
  QCOMPARE(document.scene().objects[0].position.at(6).x(), 5.0);
  this->choose(at(2, 0), "interpolation", "Smooth");
  QCOMPARE(dgtk::interpolationOf(document.scene(), crate), Interpolation::Smooth);
  this->choose(at(2, 0), "interpolation", "Steps");
  QCOMPARE(this->Checked, QString("Smooth."));
  for (int step = 0; step < 5; ++step)
  {
    this->action("undo")->trigger();
  }
  QCOMPARE(document.json(), before);
  this->choose(at(10, 1), "", "Remove its keys at 10");
  QCOMPARE(keyFramesOf(document.scene(), tree), Frames{ 0 });
}

void TestEditorTimeLine::thesisScenesCannotSayIt()
{
  this->openTwo();
  QVERIFY(this->Window->saveFile(this->path("linear.scene")));
  this->choose(at(0, 0), "keyInterpolation", "Smooth");
  QString said;
  expectRefusal(said);
  QVERIFY(!this->Window->saveFile(this->path("smooth.scene")));
  QVERIFY2(said.contains("cannot be said in .scene (expected linear interpolation"), qPrintable(said));
  QVERIFY(!QFile::exists(this->path("smooth.scene")));
}

void TestEditorTimeLine::barsMoveAndStretch()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(model("creature.md2"))));
  dgtk::SceneDocument& document = this->Window->document();
  const auto animation = [&] { return document.scene().objects[0].animation; };
  const std::string before = document.json();
  // It stands for 8 poses at 10 a second: 20 frames of 25 a second.
  this->drag(at(8, 0, true), at(14, 0, true));
  QCOMPARE(animation().start, 6.0);
  QCOMPARE(animation().rate, 1.0);
  this->drag(at(26, 0, true), at(36, 0, true));
  QCOMPARE(animation().start, 6.0);
  QCOMPARE(animation().rate, 20.0 / 30);
  QCOMPARE(document.models().size(), std::size_t(1));
  this->drag(at(36, 0, true), at(2, 0, true));
  QCOMPARE(animation().rate, 20.0);
  this->action("undo")->trigger();
  this->action("undo")->trigger();
  QCOMPARE(animation().start, 6.0);
  this->action("undo")->trigger();
  QCOMPARE(document.json(), before);
}

void TestEditorTimeLine::barsFarAwayAreDrawnAndReached()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(model("creature.md2"))));
  dgtk::SceneDocument& document = this->Window->document();
  auto* area = this->Window->findChild<QAbstractScrollArea*>("timeLineCells");
  const auto change = [&](double start, double rate)
  {
    document.editItem("far", crate,
      [=](dgtk::SceneDescription& scene)
      {
        scene.objects[0].animation.start = start;
        scene.objects[0].animation.rate = rate;
      });
    this->cells()->grab();
  };
  change(-1e9, 1); // began long ago, and has repeated ever since
  change(1e9, 1);
  change(0, 1e6);
  change(0, 1e-9);
  change(0, 0);
  change(500, 1);
  QVERIFY(area->horizontalScrollBar()->maximum() > (520 - 60) * cellWidth);
}

void TestEditorTimeLine::sequencesAreChosen()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(model("windmill.gltf"))));
  QVERIFY(this->Window->importFile(QString::fromStdString(model("creature.md2"))));
  dgtk::SceneDocument& document = this->Window->document();
  const auto animation = [&] { return document.scene().objects[1].animation; };
  // The first row has a bar, too: the second begins below it.
  const QPoint creature = at(5, 0) + QPoint(0, rowHeight + barHeight);
  this->choose(creature, "sequence", "jump");
  QCOMPARE(this->Checked, QString("stand."));
  QCOMPARE(animation().sequence, std::string("jump"));
  this->choose(creature, "", "Begin the sequence here");
  QCOMPARE(animation().start, 5.0);
  this->choose(creature, "", "Repeat the sequence");
  QVERIFY(!animation().loop);
  const auto bar = dgtk::sequenceBar(document.scene(), document.scene().objects[1], document.models());
  this->select("creature-1");
  QCOMPARE(this->field("sequenceStart.0")->text(), QString("5"));
  QCOMPARE(bar->length, 13 * 2.5);
  this->type("sequenceRate.0", "2");
  QCOMPARE(animation().rate, 2.0);
  QVERIFY(this->Window->saveFile(this->path("jump.json")));
  QCOMPARE(dgtk::readScene(this->path("jump.json").toStdString()).objects[1].animation.sequence, std::string("jump"));
}

void TestEditorTimeLine::everythingByKeys()
{
  this->openTwo();
  dgtk::SceneDocument& document = this->Window->document();
  document.addModel(model("creature.md2"));
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  this->select("crate-1");
  this->cells()->parentWidget()->setFocus();
  this->key(Qt::Key_Right, Qt::ControlModifier);
  QCOMPARE(frame->value(), 10);
  this->key(Qt::Key_Right, Qt::AltModifier);
  QCOMPARE(keyFramesOf(document.scene(), crate), (Frames{ 0, 11 }));
  QCOMPARE(frame->value(), 11);
  this->key(Qt::Key_Left, Qt::AltModifier | Qt::ControlModifier);
  QCOMPARE(keyFramesOf(document.scene(), crate), (Frames{ 0, 10, 11 }));
  this->key(Qt::Key_Right, Qt::AltModifier);
  QCOMPARE(keyFramesOf(document.scene(), crate), (Frames{ 0, 11, 12 }));
  this->key(Qt::Key_Home);
  this->key(Qt::Key_Right, Qt::AltModifier | Qt::ShiftModifier);
  QCOMPARE(document.scene().keyFrames(), (Frames{ 1, 10, 11, 12 }));
  this->key(Qt::Key_End);
  this->key(Qt::Key_K, Qt::ShiftModifier);
  QCOMPARE(document.scene().keyFrames(), (Frames{ 1, 10, 11 }));
  this->key(Qt::Key_Right);
  this->key(Qt::Key_K);
  QCOMPARE(document.scene().keyFrames(), (Frames{ 1, 10, 11, 13 }));
  this->key(Qt::Key_Down);
  this->key(Qt::Key_Down);
  QTest::keyClicks(this->cells()->parentWidget(), "]}");
  QCOMPARE(document.scene().objects[2].animation.start, 1.0);
  QCOMPARE(document.scene().objects[2].animation.rate, 20.0 / 21);
}

void TestEditorTimeLine::playsAtItsRate()
{
  this->openTwo();
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  auto* play = this->Window->findChild<QToolButton*>("play");
  auto* loop = this->Window->findChild<QToolButton*>("loop");
  auto* rate = this->Window->findChild<QDoubleSpinBox*>("frameRate");
  QCOMPARE(rate->value(), 25.0);
  const QSignalSpy frames(frame, QOverload<int>::of(&QSpinBox::valueChanged));
  const QSignalSpy rates(rate, QOverload<double>::of(&QDoubleSpinBox::valueChanged));
  frame->selectAll();
  QTest::keyClicks(frame, "12");
  rate->selectAll();
  QTest::keyClicks(rate, "30");
  QVERIFY2(rates.isEmpty() && frames.count() <= 1, "not at each digit");
  QTest::keyClick(rate, Qt::Key_Return);
  QCOMPARE(rates.count(), 1);
  QTest::keyClick(frame, Qt::Key_Return);
  QCOMPARE(frames.count(), 1);
  QCOMPARE(frame->value(), 12);
  frame->setValue(0);
  this->action("undo")->trigger();
  rate->setValue(20);
  QCOMPARE(this->Window->document().scene().fps, 20.0);
  for (const char* const typed : { "23.976", "0.001", "1000000", "20" })
  {
    rate->selectAll();
    QTest::keyClicks(rate, typed);
    QTest::keyClick(rate, Qt::Key_Return);
    QCOMPARE(this->Window->document().scene().fps, QString(typed).toDouble());
    QCOMPARE(rate->value(), QString(typed).toDouble());
  }
  loop->setChecked(false);
  QElapsedTimer clock;
  clock.start();
  this->cells()->parentWidget()->setFocus();
  this->key(Qt::Key_Space);
  QVERIFY(play->isChecked());
  QTRY_VERIFY(!play->isChecked());
  QCOMPARE(frame->value(), 10);
  QVERIFY2(clock.elapsed() >= 500, "ten frames, twenty a second");
  // Loops, pauses where it is, and goes on from there.
  loop->setChecked(true);
  play->click();
  QCOMPARE(frame->value(), 0);
  QTRY_VERIFY(frame->value() > 5);
  QTRY_VERIFY(frame->value() < 5);
  play->click();
  const int paused = frame->value();
  QTest::qWait(settle);
  QCOMPARE(frame->value(), paused);
  for (int i = 0; i < 5; ++i)
  {
    this->action("undo")->trigger();
  }
  QCOMPARE(rate->value(), 25.0);
}

void TestEditorTimeLine::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  this->openTwo();
  dgtk::SceneDocument& document = this->Window->document();
  for (const char* name : { "creature.md2", "windmill.gltf" })
  {
    document.addModel(model(name));
  }
  document.edit("motion",
    [](dgtk::SceneDescription& scene)
    {
      dgtk::setKeyInterpolation(scene, tree, 0, Interpolation::Step);
      dgtk::setItemPosition(scene, crate, 24, { 4, 0, 2 });
      dgtk::setKeyInterpolation(scene, crate, 10, Interpolation::Smooth);
      scene.objects[2].animation.sequence = "walk";
      scene.objects[2].animation.start = 6;
    });
  this->select("crate-1");
  auto* line = this->cells()->parentWidget()->parentWidget();
  this->Window->resize(1280, 860);
  QTest::qWait(settle);
  this->drag(at(24, 0), at(29, 0), {}, false);
  QTest::qWait(settle);
  QVERIFY(line->grab().save(folder + "/editor_timeline.png"));
}

DGTK_EDITOR_TEST(TestEditorTimeLine);
