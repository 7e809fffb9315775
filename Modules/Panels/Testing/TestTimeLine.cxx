// SPDX-License-Identifier: BSD-3-Clause
// The time line's places, and what its mouse and keys do to a scene; on no display.
#include "dgtkEditorState.h"
#include "dgtkTimeLine.h"
#include "dgtkTimeLineCells.h"
#include "dgtkTimeLineRows.h"

#include "dgtkFourItems.h"
#include "dgtkSequenceBar.h"
#include "dgtkTestWidgets.h"

#include <QApplication>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QScrollBar>
#include <QToolTip>

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;
using namespace dgtk::timeline;
using test::crate;
using test::creature;
using test::eye;
using test::lamp;

TEST(TimeLine, ARateThatIsBeingTypedIsTakenBeforeOtherThings)
{
  test::needApplication();
  EditorState state(nullptr);
  TimeLine line(state, nullptr);
  line.findChild<QWidget*>("frameRate")->findChild<QLineEdit*>()->setText("30.5");
  EXPECT_EQ(state.scene().fps, SceneDescription().fps);
  state.finishTyping();
  EXPECT_EQ(state.scene().fps, 30.5);
  EXPECT_EQ(state.document().undoText(), "Change frame rate");
}

TEST(TimeLine, UndoIsTheWindowsWhileNoFrameIsTyped)
{
  test::needApplication();
  EditorState state(nullptr);
  TimeLine line(state, nullptr);
  for (const char* name : { "frame", "frameRate" })
  {
    auto* const box = line.findChild<QWidget*>(name);
    auto* const text = box->findChild<QLineEdit*>();
    EXPECT_FALSE(test::takesUndo(*box)) << name;
    text->setText("12");
    text->setModified(true);
    EXPECT_TRUE(test::takesUndo(*box)) << name;
    test::sendKey(*box, Qt::Key_Return);
    EXPECT_FALSE(test::takesUndo(*box)) << name;
  }
  EXPECT_EQ(state.frame(), 12);
  EXPECT_EQ(state.scene().fps, 12);
}

TEST(TimeLineRows, HaveTheirPlaces)
{
  SceneDocument document;
  test::fill(document);
  TimeLineRows shown;
  shown.fill(document.scene(), document.models());
  shown.width = 800;
  EXPECT_EQ(shown.keys, (std::vector<int>{ 4, 8, 12, 20 }));
  struct Expected
  {
    SceneItem item;
    const char* name;
    std::vector<int> keys;
    bool bar;
    int top, height;
  };
  const std::vector<Expected> rows{ { creature, "creature", {}, true, 0, 34 }, { crate, "crate", {}, false, 34, 18 },
    { lamp, "lamp", { 4, 8 }, false, 52, 18 }, { eye, "eye", { 20 }, false, 70, 18 } };
  ASSERT_EQ(shown.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    EXPECT_TRUE(shown.rows[i].item == rows[i].item) << i;
    EXPECT_EQ(shown.rows[i].name, rows[i].name);
    EXPECT_EQ(shown.rows[i].keys, rows[i].keys) << i;
    EXPECT_EQ(shown.rows[i].bar.has_value(), rows[i].bar) << i;
    EXPECT_EQ(shown.rows[i].top, rows[i].top) << i;
    EXPECT_EQ(shown.rows[i].height, rows[i].height) << i;
  }
  EXPECT_EQ(shown.rows[2].kinds, (std::vector<Interpolation>{ Interpolation::Step, Interpolation::Linear }));
  EXPECT_EQ(shown.height(), 88);
  EXPECT_EQ(TimeLineRows().height(), 0);
  // The walk of 11 poses at 10 a second lasts 27.5 frames of 25 a second: up to 37.5.
  EXPECT_EQ(shown.frames(0), 67);
  EXPECT_EQ(shown.frames(50), 80) << "30 behind the current one";
  EXPECT_EQ(shown.frames(largestFrame), largestFrame + 1) << "the last one, too";
  EXPECT_EQ(TimeLineRows().frames(0), 60);
  shown.rows[0].bar->length = std::numeric_limits<double>::infinity();
  EXPECT_EQ(shown.frames(0), 60);
  shown.keys.back() = 100;
  EXPECT_EQ(shown.frames(0), 130);
  shown.scrolled = QPoint(24, 5);
  EXPECT_EQ(shown.leftOf(0), 130 - 24);
  EXPECT_EQ(shown.leftOf(3), 130 + 36 - 24);
  EXPECT_EQ(shown.middleOf(3), 130 + 42 - 24);
  EXPECT_EQ(shown.middleOf(1e9), 1000000);
  EXPECT_EQ(shown.middleOf(-1e9), -1000000);
  EXPECT_EQ(shown.frameAt(130), 2);
  EXPECT_EQ(shown.frameAt(141), 2);
  EXPECT_EQ(shown.frameAt(142), 3);
  EXPECT_EQ(shown.frameAt(-1000), 0);
  EXPECT_EQ(shown.frameAt(2000000000), largestFrame);
  EXPECT_EQ(shown.topOf(shown.rows[1]), 26 + 34 - 5);
}

TEST(TimeLineRows, WhatIsUnderTheMouse)
{
  SceneDocument document;
  test::fill(document);
  TimeLineRows shown;
  shown.fill(document.scene(), document.models());
  shown.width = 800;
  const auto x = [](double frame) { return int(130 + frame * 12); };
  struct Row
  {
    int x, y;
    Target target;
    int row; ///< -1: none
    int frame;
  };
  const int barY = 26 + 20;
  for (const Row& row : std::vector<Row>{ { 10, 5, Target::Nothing, -1, 0 }, { 129, 20, Target::Nothing, -1, 0 },
         { 130, 20, Target::Frames, -1, 0 }, { 130, 59, Target::Frames, 0, 0 }, { x(8.5), 14, Target::Frames, -1, 8 },
         { x(8.5), 15, Target::SceneKey, -1, 8 }, { x(8.5), 25, Target::SceneKey, -1, 8 },
         { x(9.5), 20, Target::Frames, -1, 9 }, { x(12.5), 20, Target::SceneKey, -1, 12 },
         { 10, 26, Target::Names, 0, 0 }, { 129, 59, Target::Names, 0, 0 }, { x(3.5), 30, Target::Frames, 0, 3 },
         { x(9.5), barY, Target::Frames, 0, 9 }, { x(10.5) - 1, barY, Target::Frames, 0, 10 },
         { x(10.5), barY, Target::Bar, 0, 10 }, { x(20), 26 + 17, Target::Frames, 0, 20 },
         { x(20), 26 + 18, Target::Bar, 0, 20 }, { x(20), 26 + 33, Target::Bar, 0, 20 },
         { x(20), 26 + 34, Target::Frames, 1, 20 }, { x(38) - 5, barY, Target::Bar, 0, 37 },
         { x(38) - 4, barY, Target::BarEnd, 0, 37 }, { x(38) + 4, barY, Target::BarEnd, 0, 38 },
         { x(38) + 5, barY, Target::Frames, 0, 38 }, { x(4.5), 26 + 52, Target::Key, 2, 4 },
         { x(4.5), 26 + 69, Target::Key, 2, 4 }, { x(5.5), 26 + 60, Target::Frames, 2, 5 },
         { x(4.5), 26 + 72, Target::Frames, 3, 4 }, { x(20.5), 26 + 72, Target::Key, 3, 20 },
         { x(20.5), 26 + 87, Target::Key, 3, 20 }, { x(20.5), 26 + 88, Target::Nothing, -1, 20 } })
  {
    const Hit hit = shown.hitAt({ row.x, row.y });
    EXPECT_EQ(int(hit.target), int(row.target)) << row.x << ' ' << row.y;
    EXPECT_EQ(hit.row ? int(*hit.row) : -1, row.row) << row.x << ' ' << row.y;
    EXPECT_EQ(hit.frame, row.frame) << row.x << ' ' << row.y;
  }
  // A bar without an end goes on to the right, and cannot be grasped there.
  shown.rows[0].bar->length = std::numeric_limits<double>::infinity();
  EXPECT_EQ(int(shown.hitAt({ 799, barY }).target), int(Target::Bar));
}

TEST(TimeLineRows, BarsThatAreDragged)
{
  SceneDocument document;
  test::fill(document);
  TimeLineRows shown;
  shown.fill(document.scene(), document.models());
  shown.rows[0].bar->start = 10.4;
  shown.rows[0].bar->length = 27.5;
  const auto dragged = [&](Target target, std::size_t row, int from, int to)
  {
    Drag drag;
    drag.from.target = target;
    drag.from.row = row;
    drag.from.frame = from;
    drag.to = to;
    const SequenceBar bar = shown.draggedBar(0, drag);
    return std::pair(bar.start, bar.length);
  };
  EXPECT_EQ(dragged(Target::Bar, 0, 15, 18), std::pair(13.0, 27.5)) << "to whole frames";
  EXPECT_EQ(dragged(Target::Bar, 0, 15, 11), std::pair(6.0, 27.5));
  EXPECT_EQ(dragged(Target::Bar, 1, 15, 18), std::pair(10.4, 27.5)) << "another row";
  EXPECT_EQ(dragged(Target::BarEnd, 0, 37, 37), std::pair(10.4, 27.5));
  EXPECT_EQ(dragged(Target::BarEnd, 0, 37, 40).first, 10.4);
  EXPECT_NEAR(dragged(Target::BarEnd, 0, 37, 40).second, 41 - 10.4, 1e-12) << "from 37.9";
  EXPECT_EQ(dragged(Target::BarEnd, 0, 37, 2).second, 1) << "no less than a frame";
  EXPECT_EQ(dragged(Target::Key, 0, 15, 18), std::pair(10.4, 27.5));
  EXPECT_EQ(shown.draggedBar(0, std::nullopt).start, 10.4);
}

class TimeLineTable : public testing::Test
{
protected:
  void SetUp() override
  {
    test::needApplication();
    this->State = std::make_unique<EditorState>(nullptr);
    test::fill(this->State->document());
    this->Cells = std::make_unique<TimeLineCells>(*this->State, nullptr);
    this->Cells->resize(900, 200);
    QResizeEvent event(this->Cells->size(), QSize(1, 1));
    QApplication::sendEvent(this->Cells.get(), &event);
    QObject::connect(this->Cells.get(), &TimeLineCells::playAsked, [this] { ++this->Played; });
  }
  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier, const QString& text = {})
  {
    QKeyEvent event(QEvent::KeyPress, key, modifiers, text);
    QApplication::sendEvent(this->Cells.get(), &event);
  }
  void mouse(QEvent::Type type, const QPoint& at, Qt::KeyboardModifiers modifiers = Qt::NoModifier,
    Qt::MouseButton button = Qt::LeftButton)
  {
    QMouseEvent event(type, at, button, button, modifiers);
    QApplication::sendEvent(this->Cells->viewport(), &event);
  }
  void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    this->mouse(QEvent::MouseButtonPress, from);
    this->mouse(QEvent::MouseMove, to, modifiers);
    this->mouse(QEvent::MouseButtonRelease, to, modifiers);
  }
  static QPoint at(double frame, int y) { return { int(130 + frame * 12), y }; }
  std::vector<int> keysOf(const SceneItem& item) const { return keyFramesOf(this->State->scene(), item); }
  const AnimationDescription& animation() const { return this->State->scene().objects[0].animation; }
  /// What the latest edit was, taken back.
  std::string undone()
  {
    std::string text = this->State->document().undoText();
    this->State->document().undo();
    return text;
  }

  std::unique_ptr<EditorState> State;
  std::unique_ptr<TimeLineCells> Cells;
  int Played = 0;
};

TEST_F(TimeLineTable, KeysOfTheKeyboard)
{
  using Keys = std::vector<int>;
  this->State->setFrame(5);
  this->key(Qt::Key_Right);
  EXPECT_EQ(this->State->frame(), 6);
  this->key(Qt::Key_Left);
  this->key(Qt::Key_Left);
  EXPECT_EQ(this->State->frame(), 4);
  this->key(Qt::Key_Home);
  EXPECT_EQ(this->State->frame(), 4) << "the first key frame";
  this->key(Qt::Key_End);
  EXPECT_EQ(this->State->frame(), 20);
  this->key(Qt::Key_Left, Qt::ControlModifier);
  EXPECT_EQ(this->State->frame(), 12);
  this->key(Qt::Key_Left, Qt::ControlModifier);
  EXPECT_EQ(this->State->frame(), 8);
  this->key(Qt::Key_Right, Qt::ControlModifier);
  this->key(Qt::Key_Right, Qt::ControlModifier);
  this->key(Qt::Key_Right, Qt::ControlModifier);
  EXPECT_EQ(this->State->frame(), 20) << "there is no later one";
  this->key(Qt::Key_Space);
  EXPECT_EQ(this->Played, 1);
  const SceneItem order[] = { creature, crate, lamp, eye };
  for (std::size_t i = 0; i < 5; ++i)
  {
    this->key(Qt::Key_Down);
    EXPECT_EQ(this->State->selection(), SceneItems{ order[std::min<std::size_t>(i, 3)] }) << i;
  }
  this->key(Qt::Key_Up);
  EXPECT_EQ(this->State->selection(), SceneItems{ lamp });
  this->key(Qt::Key_Left, Qt::ControlModifier);
  EXPECT_EQ(this->State->frame(), 8) << "keys of the item that is selected";
  // Alt moves its keys over those that are there, with Ctrl it copies them.
  this->State->setFrame(4);
  this->key(Qt::Key_Right, Qt::AltModifier);
  EXPECT_EQ(this->keysOf(lamp), (Keys{ 5, 8 }));
  EXPECT_EQ(this->State->frame(), 5);
  EXPECT_EQ(this->undone(), "Move keys");
  this->State->setFrame(8);
  this->key(Qt::Key_Left, Qt::AltModifier | Qt::ControlModifier);
  EXPECT_EQ(this->keysOf(lamp), (Keys{ 4, 7, 8 }));
  EXPECT_EQ(this->undone(), "Copy keys");
  this->State->setFrame(6);
  this->key(Qt::Key_Left, Qt::AltModifier);
  EXPECT_EQ(this->keysOf(lamp), (Keys{ 4, 8 })) << "there is no key";
  this->State->setFrame(8);
  this->key(Qt::Key_Right, Qt::AltModifier | Qt::ShiftModifier);
  EXPECT_EQ(this->keysOf(lamp), (Keys{ 4, 9 }));
  EXPECT_EQ(this->undone(), "Move key frame");
  this->State->setFrame(12);
  this->key(Qt::Key_Right, Qt::AltModifier | Qt::ShiftModifier | Qt::ControlModifier);
  EXPECT_EQ(this->State->scene().keyFrames(), (Keys{ 4, 8, 12, 13, 20 }));
  EXPECT_EQ(this->undone(), "Copy key frame");
  this->State->setFrame(8);
  this->key(Qt::Key_K, Qt::ShiftModifier);
  EXPECT_EQ(this->State->scene().keyFrames(), (Keys{ 4, 12, 20 }));
  EXPECT_EQ(this->undone(), "Remove key frame");
  this->State->setFrame(6);
  this->key(Qt::Key_K);
  EXPECT_EQ(this->keysOf(crate), Keys{ 6 });
  EXPECT_EQ(this->undone(), "Make key frame");
}

TEST_F(TimeLineTable, BracketsMoveAndStretchABar)
{
  const double rate = this->animation().rate;
  this->key(Qt::Key_BracketRight, Qt::NoModifier, "]");
  EXPECT_EQ(this->animation().start, 10) << "nothing is selected";
  this->State->select({ creature });
  this->key(Qt::Key_BracketRight, Qt::NoModifier, "]");
  EXPECT_EQ(this->animation().start, 11);
  this->key(Qt::Key_BracketLeft, Qt::NoModifier, "[");
  this->key(Qt::Key_BracketLeft, Qt::NoModifier, "[");
  EXPECT_EQ(this->animation().start, 9);
  EXPECT_EQ(this->undone(), "Move sequence");
  this->key(Qt::Key_BraceRight, Qt::ShiftModifier, "}");
  EXPECT_NEAR(this->animation().rate, rate * 27.5 / 28.5, 1e-12);
  EXPECT_EQ(this->undone(), "Change speed of sequence");
  this->key(Qt::Key_BraceLeft, Qt::ShiftModifier, "{");
  EXPECT_NEAR(this->animation().rate, rate * 27.5 / 26.5, 1e-12);
  this->State->select({ crate });
  const std::string before = this->State->document().json();
  this->key(Qt::Key_BraceLeft, Qt::ShiftModifier, "{");
  EXPECT_EQ(this->State->document().json(), before) << "it has no sequence";
}

TEST_F(TimeLineTable, TheMouseSelectsAndDrags)
{
  using Keys = std::vector<int>;
  const int lampY = 26 + 60;
  const int barY = 26 + 25;
  this->mouse(QEvent::MouseButtonPress, at(7.5, 10));
  EXPECT_EQ(this->State->frame(), 7);
  this->mouse(QEvent::MouseMove, at(9.5, 10));
  EXPECT_EQ(this->State->frame(), 9) << "it follows the mouse";
  this->mouse(QEvent::MouseButtonRelease, at(9.5, 10));
  this->mouse(QEvent::MouseButtonPress, { 20, lampY });
  this->mouse(QEvent::MouseButtonRelease, { 20, lampY });
  EXPECT_EQ(this->State->selection(), SceneItems{ lamp });
  EXPECT_EQ(this->State->frame(), 9) << "names are no frames";
  this->mouse(QEvent::MouseButtonPress, { 20, 26 + 40 }, Qt::ControlModifier);
  EXPECT_EQ(this->State->selection(), (SceneItems{ lamp, crate }));
  this->mouse(QEvent::MouseButtonPress, { 20, 26 + 40 }, Qt::ControlModifier);
  EXPECT_EQ(this->State->selection(), SceneItems{ lamp });
  this->State->select({ lamp, crate });
  this->mouse(QEvent::MouseButtonPress, { 20, lampY }, Qt::NoModifier, Qt::RightButton);
  EXPECT_EQ(this->State->selection(), (SceneItems{ lamp, crate })) << "a menu of several";
  this->mouse(QEvent::MouseButtonPress, { 20, 26 + 75 }, Qt::NoModifier, Qt::RightButton);
  EXPECT_EQ(this->State->selection(), SceneItems{ eye });

  this->drag(at(8.5, lampY), at(10.5, lampY));
  EXPECT_EQ(this->keysOf(lamp), (Keys{ 4, 10 }));
  EXPECT_EQ(this->State->frame(), 10);
  EXPECT_EQ(this->State->selection(), SceneItems{ lamp });
  EXPECT_EQ(this->undone(), "Move keys");
  this->drag(at(8.5, lampY), at(10.5, lampY), Qt::ControlModifier);
  EXPECT_EQ(this->keysOf(lamp), (Keys{ 4, 8, 10 }));
  EXPECT_EQ(this->undone(), "Copy keys");
  this->drag(at(20.5, 20), at(22.5, 20));
  EXPECT_EQ(this->keysOf(eye), Keys{ 22 });
  EXPECT_EQ(this->undone(), "Move key frame");
  this->drag(at(20.5, 20), at(22.5, 20), Qt::ControlModifier);
  EXPECT_EQ(this->keysOf(eye), (Keys{ 20, 22 }));
  EXPECT_EQ(this->undone(), "Copy key frame");
  const std::string before = this->State->document().json();
  this->drag(at(8.5, lampY), at(8.9, lampY));
  this->drag(at(6.5, lampY), at(9.5, lampY));
  EXPECT_EQ(this->State->document().json(), before) << "nothing was moved";

  this->State->setFrame(3);
  this->drag(at(15.5, barY), at(18.5, barY));
  EXPECT_EQ(this->animation().start, 13);
  EXPECT_EQ(this->State->frame(), 3) << "bars are no frames";
  EXPECT_EQ(this->undone(), "Move sequence");
  this->drag(at(38, barY), at(48, barY));
  EXPECT_NEAR(this->animation().rate, 27.5 / 38, 1e-2) << "to the frame 48";
  EXPECT_EQ(this->undone(), "Change speed of sequence");
  // Escape, and a change of the scene, end a drag.
  this->mouse(QEvent::MouseButtonPress, at(8.5, lampY));
  this->mouse(QEvent::MouseMove, at(10.5, lampY));
  this->key(Qt::Key_Escape);
  this->mouse(QEvent::MouseButtonRelease, at(10.5, lampY));
  EXPECT_EQ(this->State->document().json(), before);
}

TEST_F(TimeLineTable, CursorsSayWhatCanBeDragged)
{
  const auto cursorAt = [&](const QPoint& place, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    QMouseEvent event(QEvent::MouseMove, place, Qt::NoButton, Qt::NoButton, modifiers);
    QApplication::sendEvent(this->Cells->viewport(), &event);
    return this->Cells->viewport()->cursor().shape();
  };
  const int barY = 26 + 25;
  EXPECT_EQ(cursorAt(at(8.5, 26 + 60)), Qt::PointingHandCursor);
  EXPECT_EQ(cursorAt(at(8.5, 26 + 60), Qt::ControlModifier), Qt::DragCopyCursor);
  EXPECT_EQ(cursorAt(at(12.5, 20)), Qt::PointingHandCursor);
  EXPECT_EQ(cursorAt(at(20, barY)), Qt::SizeAllCursor);
  EXPECT_EQ(cursorAt(at(38, barY)), Qt::SizeHorCursor);
  EXPECT_EQ(cursorAt(at(3.5, 26 + 60)), Qt::ArrowCursor);
  const auto tipAt = [&](const QPoint& place)
  {
    QToolTip::hideText();
    QHelpEvent event(QEvent::ToolTip, place, this->Cells->viewport()->mapToGlobal(place));
    QApplication::sendEvent(this->Cells->viewport(), &event);
    return QToolTip::text();
  };
  this->Cells->show();
  EXPECT_EQ(tipAt(at(8.5, 26 + 60)), "Drag: move the key. Ctrl: copy it. Right click: interpolation.");
  EXPECT_EQ(tipAt(at(12.5, 20)), "Drag: move this key frame of the whole scene. Ctrl: copy it.");
  EXPECT_EQ(tipAt(at(20, barY)), "Drag: move the start of the sequence.");
  EXPECT_EQ(tipAt(at(38, barY)), "Drag: change the speed of the sequence.");
}

TEST_F(TimeLineTable, TheFrameAndTheRowAreBroughtIntoSight)
{
  this->Cells->resize(430, 70); // 25 frames and a little
  QResizeEvent event(this->Cells->size(), QSize(1, 1));
  QApplication::sendEvent(this->Cells.get(), &event);
  QScrollBar* const across = this->Cells->horizontalScrollBar();
  QScrollBar* const down = this->Cells->verticalScrollBar();
  const int width = this->Cells->viewport()->width();
  const int height = this->Cells->viewport()->height();
  this->State->setFrame(40);
  EXPECT_EQ(across->value(), 130 + 41 * 12 - width);
  this->State->setFrame(35);
  EXPECT_EQ(across->value(), 130 + 41 * 12 - width) << "it is in sight";
  this->State->setFrame(2);
  EXPECT_EQ(across->value(), 24);
  EXPECT_EQ(down->maximum(), 88 - height + 26);
  this->State->select({ eye });
  EXPECT_EQ(down->value(), std::min(70, 88 - (height - 26)));
  this->State->select({ creature });
  EXPECT_EQ(down->value(), 0);
  // What an edit adds can be scrolled to.
  const int before = down->maximum();
  this->State->document().edit("Camera",
    [](SceneDescription& scene)
    {
      CameraDescription more = scene.cameras.front();
      more.name = "more";
      more.eye.keys = { { 0, more.eye.at(0) }, { 200, more.eye.at(0) } };
      scene.cameras.push_back(more);
    });
  EXPECT_GT(down->maximum(), before);
  EXPECT_GE(across->maximum(), 130 + 201 * 12 - width);
}

} // namespace
