// SPDX-License-Identifier: BSD-3-Clause
// The window of correspondences: its numbers, its list and the marks of that, on no display.
#include "dgtkMatchDialog.h"
#include "dgtkMatchPane.h"

#include "dgtkFile.h"
#include "dgtkTestSupport.h"
#include "dgtkTestWidgets.h"

#include <QCheckBox>
#include <QComboBox>
#include <QImage>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTimer>

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

namespace
{
using namespace dgtk;

/// A crate before cameras of 64 x 48 pixels that see it in their middle; the left one moves.
class MatchDialogTable : public testing::Test
{
protected:
  void SetUp() override
  {
    test::needApplication();
    this->Dialog = std::make_unique<MatchDialog>(this->State, nullptr);
    const std::string model = test::sourceFile("Data/Models/crate.ac");
    writeFile(
      this->Folder.path("s.json"), R"({ "objects": [ { "name": "crate", "model": ")" + model + R"(" } ], "cameras": [
        { "name": "left", "width": 64, "height": 48, "eye": { "keys": [[0, [0, 1, 4]], [3, [0, 1, 5]]] },
          "lookAt": [0, 0.4, 0] },
        { "name": "right", "width": 64, "height": 48, "eye": [0.2, 1, 4], "lookAt": [0.2, 0.4, 0] },
        { "name": "round", "model": "equirectangular", "width": 64, "height": 32, "eye": [0.3, 1, 4],
          "lookAt": [0, 0.4, 0] },
        { "name": "rolling", "width": 64, "height": 48, "eye": [0.2, 1, 4], "lookAt": [0.2, 0.4, 0],
          "rollingShutter": { "duration": 0.5 } } ] })");
    this->State.document().open(this->Folder.path("s.json"));
    this->Dialog->show();
  }
  template <typename Part>
  Part* part(const char* name)
  {
    return this->Dialog->findChild<Part*>(name);
  }
  std::string text(const char* label) { return this->part<QLabel>(label)->text().toStdString(); }
  static void waitUntil(const std::function<bool()>& there)
  {
    while (!there())
    {
      QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
  }
  void waitForMatch()
  {
    waitUntil([this] { return this->text("match.class") != "-"; });
  }
  void pick(double x, double y)
  {
    emit this->part<MatchPane>("pane.0")->picked(x, y);
    this->waitForMatch();
  }
  void addPair(double x, double y)
  {
    this->pick(x, y);
    this->part<QPushButton>("addPair")->click();
  }
  /// Another camera of a side, and what its match is then.
  void choose(const char* side, const char* camera)
  {
    this->part<QComboBox>(side)->setCurrentText(camera);
    this->waitForMatch();
  }
  /// Whether the pairs may be discarded; asked about them, the answer is Cancel.
  bool mayDiscard()
  {
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout,
      []
      {
        if (auto* const box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
        {
          box->button(QMessageBox::Cancel)->click();
        }
      });
    timer.start(0);
    return this->Dialog->mayDiscard();
  }
  QString list(const std::string& text)
  {
    writeFile(this->Folder.path("list.txt"), text);
    return QString::fromStdString(this->Folder.path("list.txt"));
  }
  MatchTable& table() { return *this->part<MatchTable>("matchTable"); }

  test::TemporaryFolder Folder;
  EditorState State{ nullptr };
  std::unique_ptr<MatchDialog> Dialog;
};

TEST_F(MatchDialogTable, SmallStepsLeaveTheCentres)
{
  auto* const centers = this->part<QCheckBox>("centers");
  this->pick(32.25, 24.75);
  EXPECT_EQ(this->text("match.from"), "left, frame 0:  32.5, 24.5");
  test::sendKey(*this->part<MatchPane>("pane.0"), Qt::Key_Right);
  EXPECT_EQ(this->text("match.from"), "left, frame 0:  33.5, 24.5");
  EXPECT_TRUE(centers->isChecked());
  test::sendKey(*this->part<MatchPane>("pane.0"), Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_EQ(this->text("match.from"), "left, frame 0:  33.6, 24.5");
  EXPECT_FALSE(centers->isChecked());
}

TEST_F(MatchDialogTable, PairsThatAreInNoFileAreAskedAbout)
{
  const QString file = this->list("# from left@0 64x48\n# to right@0 64x48\n1.5 2.5 3 4 1 1\n");
  ASSERT_TRUE(this->Dialog->openPairs(file));
  EXPECT_TRUE(this->mayDiscard()) << "they are in that file";
  this->addPair(32, 24);
  ASSERT_EQ(this->table().pairs().size(), 2u);
  EXPECT_FALSE(this->mayDiscard());
  ASSERT_TRUE(this->Dialog->savePairs(file));
  EXPECT_TRUE(this->mayDiscard()) << "saved";
  this->table().clearAll();
  EXPECT_TRUE(this->mayDiscard()) << "there are none";
  this->addPair(32, 24);
  ASSERT_TRUE(this->Dialog->openPairs(file));
  EXPECT_EQ(this->table().pairs().size(), 3u);
  EXPECT_FALSE(this->mayDiscard()) << "the first is in no file";
}

TEST_F(MatchDialogTable, PairsAreOfBothViews)
{
  auto* const pane = this->part<MatchPane>("pane.0");
  pane->setFixedSize(320, 240); // whatever the numbers take
  waitUntil([&] { return pane->property("step").toInt() == 1; });
  this->pick(32, 24);
  const QImage without = pane->grab().toImage();
  this->part<QPushButton>("addPair")->click();
  EXPECT_NE(pane->grab().toImage(), without) << "its mark";
  this->part<QPushButton>("addPair")->click();
  EXPECT_EQ(this->table().pairs().size(), 1u) << "it is there already";
  this->part<QSpinBox>("frame.1")->setValue(1);
  this->waitForMatch();
  EXPECT_EQ(pane->grab().toImage(), without) << "it is of another frame there";
  this->part<QPushButton>("addPair")->click();
  ASSERT_EQ(this->table().pairs().size(), 2u);
  EXPECT_EQ(this->table().pairs()[1].to.frame, 1);
}

TEST_F(MatchDialogTable, ARowIsOfTheViewsThatItNames)
{
  ASSERT_TRUE(this->Dialog->openPairs(this->list("# from left@2 64x48\n# to right@1 64x48\n31.25 24.5 30 20 1 1\n"
                                                 "# from gone%3@1 64x48\n# to right@0 64x48\n10 11 12 13 1 1\n"
                                                 "# from left@0 64x48\n# to right@0 320x240\n10 11 12 13 1 1\n"
                                                 "# from left@9 64x48\n# to right@0 64x48\n10 11 12 13 1 1\n")));
  ASSERT_EQ(this->table().pairs().size(), 4u);
  const auto click = [this](int row) { emit this->table().cellClicked(row, 0); };
  click(0);
  this->waitForMatch();
  EXPECT_EQ(this->text("match.from"), "left, frame 2:  31.25, 24.5");
  EXPECT_EQ(this->part<QSpinBox>("frame.1")->value(), 1);
  const char* const missing[] = { "gone%3, frame 1, with 64 x 48", "right, frame 0, with 320 x 240",
    "left, frame 9, with 64 x 48" };
  for (int row = 1; row < 4; ++row)
  {
    click(row);
    EXPECT_EQ(this->text("match.from"), "The scene has no view of " + std::string(missing[row - 1]) + " pixels.");
    EXPECT_EQ(this->text("match.class"), "-") << "no other point takes its place";
    EXPECT_FALSE(this->part<QPushButton>("addPair")->isEnabled());
  }
}

TEST_F(MatchDialogTable, WhyThereIsNoLine)
{
  this->pick(32, 24);
  EXPECT_NE(this->text("match.line").find(" = 0"), std::string::npos);
  this->choose("camera.1", "left");
  EXPECT_EQ(this->text("match.line"), "none: the ray is a point in the other picture, or at infinity");
  const std::string curved = "none: one of the cameras is not linear, or has a rolling shutter";
  for (const char* const right : { "round", "rolling" })
  {
    this->choose("camera.1", right);
    EXPECT_EQ(this->text("match.line"), curved) << right;
  }
  this->choose("camera.0", "round");
  this->choose("camera.1", "right");
  EXPECT_EQ(this->text("match.line"), curved);
}
} // namespace
