// SPDX-License-Identifier: BSD-3-Clause
// The log of a run and the page of its options, on no display.
#include "dgtkRenderOptions.h"
#include "dgtkRenderProcess.h"
#include "dgtkRenderStatus.h"
#include "dgtkRunFolder.h"
#include "dgtkRunLog.h"

#include "dgtkFile.h"
#include "dgtkJournal.h"
#include "dgtkRunsTest.h"
#include "dgtkTestSupport.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QStatusBar>

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

using namespace dgtk;

namespace
{
using RunTables = test::RunsTest;

/// What a log says behind these lines of the program.
struct Told
{
  RunLog::End end;
  int done, total;
  std::string last;
  std::vector<std::string> messages;
};

/// The log of a run that has ended, with these lines of the program.
RunRequest writeLog(const QString& folder, const std::string& lines)
{
  RunRequest request;
  request.folder = folder;
  request.arguments = QStringList{ "render", "a b.json", "-o", folder };
  request.scene = "0123abcd";
  const int file = RunLog(folder).begin(request);
  EXPECT_GE(file, 0);
  const std::string text = "4711\n" + lines;
  EXPECT_EQ(::write(file, text.data(), text.size()), ssize_t(text.size()));
  ::close(file);
  return request;
}

Told toldOf(const std::string& lines)
{
  RunLog log("/data/out");
  const RunRequest request = writeLog("/data/out", lines);
  Told told;
  for (const QString& message : log.read())
  {
    told.messages.push_back(message.toStdString());
  }
  EXPECT_EQ(log.request().folder, request.folder);
  EXPECT_EQ(log.request().arguments, request.arguments);
  EXPECT_EQ(log.request().scene, request.scene);
  EXPECT_EQ(log.process(), 4711);
  told.end = log.end();
  told.done = log.done();
  told.total = log.total();
  told.last = log.last().toStdString();
  return told;
}

TEST_F(RunTables, WaysToEnd)
{
  using End = RunLog::End;
  struct Row
  {
    const char* lines;
    Told told;
  };
  const Row rows[] = {
    { "", { End::Lost, 0, 0, "", {} } },
    { "3/12 pictures, 1.5/s, 0:06 left\n", { End::Lost, 3, 12, "", {} } },
    { "3/12 pictures, 1.5/s, 0:06 left\n7/12 pictures, 1.5/s, ? left\n", { End::Lost, 7, 12, "", {} } },
    { "3/12 samples, 1.5/s, 0:06 left\n", { End::Lost, 3, 12, "", {} } },
    { "3/12 pictures, 1.5/s, 0:06 left", { End::Lost, 0, 0, "", {} } }, // no whole line yet
    { "scene.json: a note\n12 pictures, 20 files in /data/out, 3.5 s\n",
      { End::Done, 0, 0, "12 pictures, 20 files in /data/out, 3.5 s",
        { "scene.json: a note", "12 pictures, 20 files in /data/out, 3.5 s" } } },
    { "12 pictures, 20 files in /data/out, 3.5 s\nanother\n",
      { End::Lost, 0, 0, "another", { "12 pictures, 20 files in /data/out, 3.5 s", "another" } } },
    { "dgtk: interrupted; the same command\n", { End::Stopped, 0, 0, "interrupted; the same command", {} } },
    { "a note\ndgtk: no space\n", { End::Failed, 0, 0, "no space", { "a note" } } },
    { "dgtk: no space\na note\n", { End::Lost, 0, 0, "a note", { "a note" } } },
    { "3/12 pictures\n", { End::Lost, 0, 0, "3/12 pictures", { "3/12 pictures" } } },
  };
  for (const Row& row : rows)
  {
    const Told found = toldOf(row.lines);
    EXPECT_EQ(int(found.end), int(row.told.end)) << row.lines;
    EXPECT_EQ(found.done, row.told.done) << row.lines;
    EXPECT_EQ(found.total, row.told.total) << row.lines;
    EXPECT_EQ(found.last, row.told.last) << row.lines;
    EXPECT_EQ(found.messages, row.told.messages) << row.lines;
  }
}

TEST_F(RunTables, ALogIsReadOnAndLockedWhileItsRunLives)
{
  RunLog log("/data/../data/one/");
  EXPECT_EQ(log.request().folder, "/data/one");
  EXPECT_FALSE(log.alive());
  EXPECT_TRUE(log.read().isEmpty());
  EXPECT_TRUE(RunLog::folders().isEmpty());
  RunRequest request;
  request.folder = "/data/one";
  const int file = log.begin(request);
  ASSERT_GE(file, 0);
  EXPECT_TRUE(log.alive());
  errno = 0;
  EXPECT_EQ(log.begin(request), -1) << "it goes on";
  EXPECT_EQ(errno, EWOULDBLOCK);
  const auto write = [&](const std::string& text)
  { EXPECT_EQ(::write(file, text.data(), text.size()), ssize_t(text.size())); };
  write("12\n1/4 pictures, 1/s, 0:03 left\nfirst\nsec");
  EXPECT_EQ(log.read(), QStringList{ "first" });
  EXPECT_TRUE(log.read().isEmpty());
  write("ond\n2/4 pictures, 1/s, 0:02 left\n");
  EXPECT_EQ(log.read(), QStringList{ "second" });
  EXPECT_EQ(log.done(), 2);
  EXPECT_EQ(log.process(), 12);
  EXPECT_FALSE(log.shown());
  log.markShown();
  EXPECT_TRUE(log.read().isEmpty());
  EXPECT_TRUE(log.shown());
  EXPECT_EQ(log.last(), "second") << "that is not the program's";
  ::close(file);
  EXPECT_FALSE(log.alive());
  EXPECT_EQ(RunLog::folders(), QStringList{ "/data/one" });

  const RunLog other("/data/two");
  request.folder = "/data/two";
  ::close(other.begin(request));
  QStringList folders = RunLog::folders();
  folders.sort(); // they are of one moment
  EXPECT_EQ(folders, (QStringList{ "/data/one", "/data/two" }));
  const QString copy = other.sceneCopy();
  EXPECT_TRUE(copy.endsWith("/scene.json"));
  EXPECT_NE(copy, log.sceneCopy());
  EXPECT_TRUE(QFileInfo(QFileInfo(copy).path()).isDir());
  // Another run into the folder begins anew.
  ::close(other.begin(request));
  RunLog again("/data/two");
  EXPECT_TRUE(again.read().isEmpty());
  EXPECT_EQ(again.process(), 0);
  other.remove();
  EXPECT_EQ(RunLog::folders(), QStringList{ "/data/one" });
  other.markShown();
  EXPECT_EQ(RunLog::folders(), QStringList{ "/data/one" }) << "no log is begun by that";
}

TEST_F(RunTables, TheLatestRunComesFirst)
{
  const char* const folders[] = { "/data/one", "/data/two", "/data/three" };
  const int ages[] = { 50, 10, 30 }; // seconds
  for (int i = 0; i < 3; ++i)
  {
    writeLog(folders[i], "");
    QFile log(QFileInfo(RunLog(folders[i]).sceneCopy()).path() + "/run.log");
    ASSERT_TRUE(log.open(QIODevice::ReadWrite));
    ASSERT_TRUE(log.setFileTime(QDateTime::currentDateTime().addSecs(-ages[i]), QFileDevice::FileModificationTime));
  }
  EXPECT_EQ(RunLog::folders(), (QStringList{ "/data/two", "/data/three", "/data/one" }));
}

TEST_F(RunTables, TheStatusBarSaysHowFarARunIs)
{
  QStatusBar bar;
  RenderStatus status(&bar);
  auto* const text = status.findChild<QPushButton*>("renderStatusText");
  auto* const progress = status.findChild<QProgressBar*>("renderStatusProgress");
  ASSERT_TRUE(text && progress);
  EXPECT_TRUE(status.isHidden());
  status.showProgress(-1, "");
  EXPECT_EQ(text->text(), "Rendering ...");
  EXPECT_EQ(progress->maximum(), 0) << "it moves, as nothing is known";
  EXPECT_FALSE(status.isHidden() || progress->isHidden());
  status.showProgress(0, "");
  EXPECT_EQ(text->text(), "Rendering: 0 %");
  EXPECT_EQ(progress->maximum(), 1000);
  status.showProgress(0.256, "0:10");
  EXPECT_EQ(text->text(), "Rendering: 25 %, 0:10 left");
  EXPECT_EQ(progress->value(), 256);
  status.showEnd("Done", "12 pictures");
  EXPECT_EQ(text->text(), "Done");
  EXPECT_EQ(text->toolTip(), "12 pictures");
  EXPECT_TRUE(progress->isHidden());
  status.showProgress(1, "");
  EXPECT_EQ(text->text(), "Rendering: 100 %");
  EXPECT_EQ(progress->value(), 1000);
  EXPECT_FALSE(progress->isHidden());
  EXPECT_NE(text->toolTip(), "12 pictures");
}

TEST_F(RunTables, CommandsCanBePastedIntoAShell)
{
  EXPECT_EQ(shellLine({ "dgtk", "render", "a/b-1_2.json", "--frames", "0:3", "x,y=%1@+" }),
    "dgtk render a/b-1_2.json --frames 0:3 x,y=%1@+");
  EXPECT_EQ(shellLine({ "a b", "", "it's", "$x", "a\nb" }), "'a b' '' 'it'\\''s' '$x' 'a\nb'");
}

TEST_F(RunTables, WhatStandsInAFolder)
{
  using Question = RunFolder::Question;
  const char* const oneOfTwo = "1/2 pictures, 1/s, 0:01 left\n";
  struct Row
  {
    const char* holds;
    std::string log;
    bool finished, unfinished, ours;
    Question goOn, goOnWithAnother, replace;
    const char* text;
  };
  const Question none = Question::None;
  const Row rows[] = {
    { "", "", false, false, false, none, none, none, "" },
    { "", oneOfTwo, false, false, false, none, none, none, "" }, // its folder was removed
    { "notes.txt", "", false, false, false, none, none, none, "" },
    { "journal", "", false, true, false, none, none, Question::Unfinished,
      "An interrupted run stands in this folder. Start goes on with it." },
    { "journal", oneOfTwo, false, true, true, none, Question::OtherScene, Question::Unfinished,
      "An interrupted run stands in this folder (1 of 2 pictures). Start goes on with it." },
    { "journal", "2 pictures, 3 files in out, 1 s\n", false, true, false, none, none, Question::Unfinished,
      "An interrupted run stands in this folder. Start goes on with it." }, // of another program, after ours
    { "manifest", oneOfTwo, true, false, false, Question::Finished, Question::Finished, Question::Finished, "" },
    { "held", "", false, false, false, none, none, none, "Another program is rendering into this folder." },
  };
  for (const Row& row : rows)
  {
    SCOPED_TRACE(std::string(row.holds) + ", " + row.log);
    const test::TemporaryFolder folder;
    const std::string holds = row.holds;
    if (!row.log.empty())
    {
      writeLog(QString::fromStdString(folder.path()), row.log);
    }
    std::unique_ptr<Journal> journal;
    if (holds == "notes.txt")
    {
      writeFile(folder.path(holds), "mine");
    }
    else if (!holds.empty())
    {
      journal = std::make_unique<Journal>(folder.path(), "request", JournalStart::Fresh);
      journal->plan({ "left/color/000000.png" });
    }
    if (holds == "manifest")
    {
      journal->close(Manifest());
    }
    if (holds != "held")
    {
      journal.reset();
    }
    const RunFolder found(QString::fromStdString(folder.path() + "/./"));
    EXPECT_EQ(found.path().toStdString(), folder.path());
    EXPECT_EQ(found.finished(), row.finished);
    EXPECT_EQ(found.unfinished(), row.unfinished);
    EXPECT_FALSE(found.rendering());
    EXPECT_EQ(found.interrupted().has_value(), row.ours);
    EXPECT_EQ(int(found.question(true, "0123abcd")), int(row.goOn));
    EXPECT_EQ(int(found.question(true, "")), int(row.goOn)) << "no other scene could be meant";
    EXPECT_EQ(int(found.question(true, "dcba")), int(row.goOnWithAnother));
    EXPECT_EQ(int(found.question(false, "0123abcd")), int(row.replace));
    EXPECT_EQ(found.text().toStdString(), row.text);
  }
}

TEST_F(RunTables, ARunIntoAFolderIsFollowed)
{
  const test::TemporaryFolder folder;
  const QString path = QString::fromStdString(folder.path());
  const Journal journal(folder.path(), "request", JournalStart::Fresh);
  RunRequest request;
  request.folder = path;
  const int file = RunLog(path).begin(request);
  ASSERT_GE(file, 0);
  EXPECT_TRUE(RunFolder(path).rendering());
  EXPECT_EQ(RunFolder(path).text(), "A run into this folder goes on. Start shows it.");
  ::close(file);
  EXPECT_FALSE(RunFolder(path).rendering());
}

TEST_F(RunTables, TheUsualFolderIsBesideTheScene)
{
  EXPECT_EQ(RunFolder::usual("/data/a.b.json"), "/data/a.b_dataset");
  EXPECT_EQ(RunFolder::usual(""), QDir::home().filePath("dataset"));
  EXPECT_EQ(RunFolder("below").path(), QDir::current().filePath("below"));
}

TEST_F(RunTables, OptionsAreWordsOfTheCommandLine)
{
  EXPECT_EQ(optionWord("points_step"), "--points-step");
  RenderOptions options(nullptr);
  EXPECT_TRUE(options.words().isEmpty()) << "nothing but defaults";
  const auto expectWords = [&](const QStringList& expected, const char* what)
  { EXPECT_EQ(options.words().join(' ').toStdString(), expected.join(' ').toStdString()) << what; };
  auto* const samples = options.findChild<QSpinBox*>("samples");
  auto* const filter = options.findChild<QComboBox*>("filter");
  auto* const shadows = options.findChild<QCheckBox*>("pov_shadows");
  auto* const pairs = options.findChild<QLineEdit*>("pairs");
  auto* const depth = options.findChild<QLineEdit*>("depth_format");
  auto* const step = options.findChild<QSpinBox*>("points_step");
  auto* const classes = options.findChild<QLineEdit*>("classes");
  ASSERT_TRUE(samples && filter && shadows && pairs && depth && step && classes);
  EXPECT_EQ(samples->minimum(), 1);
  EXPECT_EQ(samples->maximum(), 16);
  EXPECT_EQ(samples->value(), 1);
  EXPECT_EQ(filter->count(), 5);
  EXPECT_EQ(filter->currentText(), "box");
  EXPECT_EQ(filter->itemText(4), "lanczos");
  EXPECT_FALSE(shadows->isChecked());
  EXPECT_EQ(pairs->text(), "all");
  EXPECT_EQ(depth->text(), "npy");
  EXPECT_EQ(depth->placeholderText(), "NAMES");
  EXPECT_FALSE(samples->toolTip().isEmpty());
  samples->setValue(4);
  expectWords({ "--samples", "4" }, "a number");
  filter->setCurrentText("mitchell");
  shadows->setChecked(true);
  depth->setText(" npy,exr ");
  step->setValue(2);
  const QStringList all{ "--samples", "4", "--filter", "mitchell", "--points-step", "2", "--pov-shadows",
    "--depth-format", "npy,exr" };
  expectWords(all, "one of each kind");
  classes->setText("/my classes.json");
  expectWords(all + QStringList{ "--classes", "/my classes.json" }, "a file");
  classes->clear();
  pairs->setText(" ");
  expectWords(all, "what is empty is not said");
  // Options of other layers are left out.
  options.setLayers({ "depth" });
  EXPECT_TRUE(depth->isEnabled());
  EXPECT_FALSE(step->isEnabled());
  EXPECT_FALSE(shadows->isEnabled());
  EXPECT_TRUE(samples->isEnabled());
  expectWords({ "--samples", "4", "--filter", "mitchell", "--depth-format", "npy,exr" }, "depth");
  auto* const renderer = options.findChild<QComboBox*>("renderer");
  renderer->setCurrentText("povray");
  EXPECT_TRUE(shadows->isEnabled()) << "it is the renderer's, too";
  renderer->setCurrentText("vtk");
  EXPECT_FALSE(shadows->isEnabled());
  renderer->setCurrentText("ray");
  options.setLayers({ "points", "pov" });
  expectWords({ "--samples", "4", "--filter", "mitchell", "--points-step", "2", "--pov-shadows" }, "points and pov");
  options.setLayers({});
  expectWords({ "--samples", "4", "--filter", "mitchell" }, "none");
  options.offer("pairs", "left:right");
  EXPECT_EQ(pairs->text(), "left:right");
  pairs->setModified(true);
  options.offer("pairs", "a:b");
  EXPECT_EQ(pairs->text(), "left:right") << "somebody typed it";
  EXPECT_EQ(options.inWindowsWords("--points-step: expected a number"), "points_step: expected a number");
  EXPECT_EQ(options.inWindowsWords("points --points-step: x"), "points --points-step: x");
}

TEST_F(RunTables, OptionsThatFitAnySceneAreRemembered)
{
  {
    RenderOptions options(nullptr);
    options.findChild<QSpinBox*>("samples")->setValue(4);
    options.findChild<QCheckBox*>("pov_shadows")->setChecked(true);
    options.findChild<QLineEdit*>("depth_format")->setText("npy,exr");
    options.findChild<QLineEdit*>("matte")->setText("tree");
    options.findChild<QLineEdit*>("pov_focal_blur")->setText("1,2");
    options.findChild<QComboBox*>("color_bits")->setCurrentText("16");
    options.remember();
  }
  {
    RenderOptions options(nullptr);
    EXPECT_EQ(options.findChild<QSpinBox*>("samples")->value(), 4);
    EXPECT_TRUE(options.findChild<QCheckBox*>("pov_shadows")->isChecked());
    EXPECT_EQ(options.findChild<QLineEdit*>("depth_format")->text(), "npy,exr");
    EXPECT_EQ(options.findChild<QLineEdit*>("matte")->text(), "") << "of another scene";
    EXPECT_EQ(options.findChild<QLineEdit*>("pov_focal_blur")->text(), "");
    EXPECT_EQ(options.findChild<QComboBox*>("color_bits")->currentText(), "16");
    options.findChild<QSpinBox*>("samples")->setValue(1);
    options.remember();
  }
  QSettings().setValue("render/options/color_bits", "17");
  RenderOptions options(nullptr);
  EXPECT_EQ(options.findChild<QSpinBox*>("samples")->value(), 1);
  EXPECT_EQ(options.findChild<QComboBox*>("color_bits")->currentText(), "8") << "of another version";
  EXPECT_TRUE(options.findChild<QCheckBox*>("pov_shadows")->isChecked());
}
} // namespace
