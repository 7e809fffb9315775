// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkProgressEstimate.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;

TEST(ProgressEstimate, MovesBetweenReportsAndNeverFallsOrOvertakes)
{
  ProgressEstimate estimate;
  EXPECT_EQ(estimate.fractionAt(3), 0);
  EXPECT_FALSE(estimate.secondsLeftAt(3));
  double last = 0;
  for (int tenth = 0; tenth <= 400; ++tenth)
  {
    const int done = tenth / 100; // a picture every ten seconds, reported every tenth
    estimate.report(tenth / 10.0, done, 4);
    const double now = estimate.fractionAt(tenth / 10.0 + 0.05);
    EXPECT_TRUE(now > last || done == 4) << tenth;
    EXPECT_LE(now, (done + 1) / 4.0) << tenth;
    last = now;
  }
  EXPECT_EQ(last, 1);
  EXPECT_EQ(estimate.secondsLeftAt(40), 0);
}

TEST(ProgressEstimate, TellsTheTimeLeftOfAnEvenRun)
{
  ProgressEstimate estimate;
  estimate.report(1, 5, 10); // kept from an earlier run
  EXPECT_FALSE(estimate.secondsLeftAt(2));
  estimate.report(3, 6, 10);
  EXPECT_DOUBLE_EQ(*estimate.secondsLeftAt(3), 8);
  EXPECT_DOUBLE_EQ(*estimate.secondsLeftAt(5), 8 - 2 * (1 - std::exp(-1)));
  EXPECT_DOUBLE_EQ(estimate.fractionAt(5), (7 - std::exp(-1)) / 10);
  estimate.report(5, 10, 10);
  EXPECT_EQ(estimate.fractionAt(5), 1);
}
