// SPDX-License-Identifier: BSD-3-Clause
// Work beside the window: in which order it is done, and what of it is told.
#include "dgtkBackgroundQueue.h"

#include "dgtkTestWidgets.h"

#include <QCoreApplication>

#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace
{
using namespace dgtk;
using Done = BackgroundQueue::Done;
using GoOn = BackgroundQueue::GoOn;

/// A queue whose only thread is busy until release().
class BackgroundQueues : public testing::Test
{
protected:
  static constexpr int busy = 100; // its slot

  void SetUp() override
  {
    test::needApplication();
    std::promise<void> begun;
    this->Queue.post(busy, 0,
      [this, &begun](const GoOn& goOn)
      {
        begun.set_value();
        this->Go.get_future().wait();
        this->WentOn = goOn();
        return Done([this] { this->Told.push_back(busy); });
      });
    begun.get_future().wait();
  }
  /// Lets it go, and waits until the last piece of all is told.
  void release()
  {
    bool ended = false;
    this->Queue.post(busy + 1, 1000, [&](const GoOn&) { return Done([&] { ended = true; }); });
    this->Go.set_value();
    while (!ended)
    {
      QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
  }

  std::promise<void> Go;
  bool WentOn = false;
  std::vector<int> Told;
  BackgroundQueue Queue{ 1, nullptr }; // last: its thread ends first
};

TEST_F(BackgroundQueues, LowerPrioritiesComeFirst)
{
  for (const int priority : { 2, 0, 1 })
  {
    this->Queue.post(
      priority, priority, [=](const GoOn&) { return Done([this, priority] { this->Told.push_back(priority); }); });
  }
  this->release();
  EXPECT_EQ(this->Told, (std::vector<int>{ busy, 0, 1, 2 }));
  EXPECT_TRUE(this->WentOn);
}

TEST_F(BackgroundQueues, WhatIsDroppedIsNotTold)
{
  this->Queue.post(1, 0, [this](const GoOn&) { return Done([this] { this->Told.push_back(1); }); });
  this->Queue.drop(1);
  this->Queue.drop(busy);
  this->release();
  EXPECT_TRUE(this->Told.empty()) << "neither what waited nor what was begun";
  EXPECT_FALSE(this->WentOn);
}
} // namespace
