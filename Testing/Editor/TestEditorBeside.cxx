// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorBeside.h"
#include "TestEditorSupport.h"

#include <QCheckBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

#include <algorithm>
#include <vector>

namespace
{
constexpr int largeSide = 3200;     // pixels of pictures that take long
constexpr int stirring = 3000;      // milliseconds
constexpr int fewest = 4;           // rounds
constexpr double answerLimit = 200; // milliseconds
constexpr double besideRun = 10;    // times what the same takes without a run, on a machine that has other work, too
} // namespace

TestEditorBeside::Answers TestEditorBeside::stir(int milliseconds, const std::function<bool()>& goesOn)
{
  auto& timed = static_cast<TimedApplication&>(*qApp);
  timed.restart();
  double latest = 0; // milliseconds that a timer came too late in this round
  std::vector<double> lateness;
  QElapsedTimer since;
  QTimer probe;
  constexpr int every = 10;
  connect(&probe, &QTimer::timeout,
    [&]
    {
      latest = std::max(latest, double(since.nsecsElapsed()) * 1e-6 - every);
      since.restart();
    });
  since.start();
  probe.start(every);
  QElapsedTimer clock;
  clock.start();
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  const char* names[] = { "house", "tree", "vase" };
  Answers answers;
  while ((clock.elapsed() < milliseconds || answers.rounds < fewest) && goesOn())
  {
    latest = 0;
    this->select(names[answers.rounds % 3]);
    this->type("position.1", QString::number(0.001 * (answers.rounds + 1)));
    QTest::mousePress(view, Qt::LeftButton, {}, QPoint(8, 8));
    for (int step = 1; step < 4; ++step)
    {
      moveMouse(view, QPoint(8 + 9 * step, 8 + 4 * step), Qt::LeftButton);
      QCoreApplication::processEvents();
    }
    QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(40, 24));
    frame->setValue(answers.rounds % 10);
    QCoreApplication::processEvents();
    lateness.push_back(latest);
    ++answers.rounds;
  }
  // Of half of the rounds: in single ones other programs may have had the machine.
  const auto middle = lateness.begin() + std::ptrdiff_t(lateness.size() / 2);
  std::nth_element(lateness.begin(), middle, lateness.end());
  answers.late = lateness.empty() ? 0 : *middle;
  answers.longest = timed.longest();
  answers.what = timed.what();
  return answers;
}

/// While pictures are made, selecting, typing, dragging and scrubbing go on.
void TestEditorBeside::theWindowAnswersWhileItRenders()
{
  QVERIFY(this->Window->openFile(demo()));
  const Answers alone = this->stir(0, [] { return true; });
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QLineEdit*>("folder")->setText(this->path("beside"));
  check(dialog->findChild<QCheckBox*>("ownSize"), false);
  dialog->findChild<QSpinBox*>("width")->setValue(largeSide);
  dialog->findChild<QSpinBox*>("height")->setValue(largeSide);
  auto* start = dialog->findChild<QPushButton*>("start");
  start->click();
  QTRY_VERIFY(!contents(this->path("beside")).isEmpty());
  const Answers beside = this->stir(stirring, [start] { return !start->isEnabled(); });
  QVERIFY2(!start->isEnabled(), "the run was to go on all the time");
  qInfo("%d rounds beside a run: longest event %.0f ms (%s; %.0f without a run), timer %.0f ms late (%.0f); aim %.0f",
    beside.rounds, beside.longest, qPrintable(beside.what), alone.longest, beside.late, alone.late, answerLimit);
  QVERIFY(beside.longest < std::max(patience() * answerLimit, besideRun * alone.longest));
  QVERIFY(beside.late < std::max(patience() * answerLimit, besideRun * alone.late));
  dialog->findChild<QPushButton*>("cancel")->click();
  QTRY_VERIFY(start->isEnabled());
}

DGTK_EDITOR_TEST(TestEditorBeside);
