// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMeter.h"

#include <gtest/gtest.h>

namespace
{
using namespace dgtk;

Offender at(int x, int y) { return { "file", x, y, "v", "e" }; }

TEST(Meter, KeepsTheFirstOfTheLargest)
{
  Meter meter(0.5);
  meter.add(0.25, [] { return at(1, 0); });
  meter.add(-2, [] { return at(2, 0); });
  meter.add(2, [] { return at(3, 0); });
  meter.skip(4);
  EXPECT_EQ(meter.Count, 3u);
  EXPECT_EQ(meter.Skipped, 4u);
  EXPECT_EQ(meter.Bad, 2u);
  EXPECT_EQ(meter.Largest, 2);
  EXPECT_EQ(meter.Worst.x, 2);
}

TEST(Meter, WhatIsNoNumberIsInfinitelyWrong)
{
  Meter meter(1e300);
  meter.add(std::nan(""), [] { return at(0, 0); });
  EXPECT_EQ(meter.Bad, 1u);
  EXPECT_EQ(meter.Largest, infinite);
}

TEST(Meter, RowsAreTheSameForAnyThreads)
{
  // Equal residuals in all rows: the first one is the one to name.
  const auto measure = [](int threads)
  {
    ThreadPool pool(threads);
    return meterRows(pool, 100, 0.5,
      [](int y, Meter& meter)
      {
        meter.add(y % 10 == 7 ? 3 : 0.1, [&] { return at(0, y); });
        meter.skip(y < 50 ? 2 : 0);
      });
  };
  for (const int threads : { 1, 2, 5 })
  {
    const Meter meter = measure(threads);
    EXPECT_EQ(meter.Count, 100u);
    EXPECT_EQ(meter.Bad, 10u);
    EXPECT_EQ(meter.Skipped, 100u);
    EXPECT_EQ(meter.Largest, 3);
    EXPECT_EQ(meter.Worst.y, 7);
  }
}

TEST(Results, FirstBreachIsInTheOrderOfChecks)
{
  Results results;
  Meter bad(0);
  bad.equal(false, [] { return at(0, 0); });
  Meter good(0);
  good.good(5);
  results.startCheck(3, "late");
  results.add({ "a", "", {} }, bad);
  results.startCheck(1, "early");
  results.add({ "b", "", {} }, good);
  results.add({ "c", "", {} }, bad);
  results.add({ "empty", "", {} }, Meter(0));
  const VerificationReport report = results.report();
  ASSERT_EQ(report.residuals.size(), 3u);
  ASSERT_NE(report.firstBreach(), nullptr);
  EXPECT_EQ(report.firstBreach()->check, "early");
  EXPECT_EQ(report.firstBreach()->layer, "c");
  EXPECT_FALSE(report.passed());
  EXPECT_FALSE(VerificationReport{}.passed()) << "nothing was checked";
}

TEST(Results, RowsOfOneLayerAreAddedUp)
{
  Results results;
  results.startCheck(0, "check");
  for (const int part : { 1, 2, 3 })
  {
    Meter meter(0.5);
    meter.add(part == 2 ? 4 : 1, [&] { return at(part, 0); });
    meter.good(10);
    meter.skip(100);
    results.add({ "layer", "pixel", {} }, meter);
  }
  const VerificationReport report = results.report();
  ASSERT_EQ(report.residuals.size(), 1u);
  EXPECT_EQ(report.residuals[0].count, 33u);
  EXPECT_EQ(report.residuals[0].skipped, 300u);
  EXPECT_EQ(report.residuals[0].bad, 3u);
  EXPECT_EQ(report.residuals[0].largest, 4);
  EXPECT_EQ(report.residuals[0].worst.x, 2);
  EXPECT_EQ(report.residuals[0].tolerance, 0.5);
  EXPECT_EQ(report.residuals[0].unit, "pixel");
}

TEST(Numbers, AreTheShortestTextThatReadsBack)
{
  const double values[] = { 0.1, -2, 1e300 };
  EXPECT_EQ(numbersText(values, 3), "(0.1, -2, 1e+300)");
  EXPECT_EQ(numbersText(values, 1), "0.1");
  EXPECT_EQ(numberText(infinite), "inf");
  EXPECT_EQ(numberText(-infinite), "-inf");
  EXPECT_EQ(numberText(std::nan("")), "nan");
}

TEST(Results, ARowThatLeavesTooMuchOpenIsABreach)
{
  const auto reportOf = [](std::uint64_t open)
  {
    Results results;
    Meter meter(0);
    meter.good(1000 - open);
    meter.skip(open);
    results.startCheck(0, "check");
    results.add({ "layer", "", {}, 0.05 }, meter);
    return results.report();
  };
  EXPECT_TRUE(reportOf(66).passed()) << "a twentieth, and a few of a small picture";
  const VerificationReport report = reportOf(67);
  EXPECT_FALSE(report.passed());
  ASSERT_NE(report.firstBreach(), nullptr);
  EXPECT_EQ(report.firstBreach()->bad, 0u);
  EXPECT_EQ(describe(*report.firstBreach()),
    "dataset: 67 of 1000 values left open, expected at most 5.00e+00 % (check check, layer layer)");
  EXPECT_NE(verificationTable(report).find("BREACH (open)"), std::string::npos);
}

TEST(Results, KnowsTheFilesThatItsRowsCompare)
{
  Results results;
  Meter meter(0);
  meter.good();
  results.add({ "layer", "", { "a.npy" } }, meter);
  results.unusable("layer", "b.npy", "damaged");
  EXPECT_TRUE(results.compares("a.npy"));
  EXPECT_TRUE(results.compares("b.npy"));
  EXPECT_FALSE(results.compares("c.npy"));
}

TEST(Results, SayAFileOnce)
{
  const auto found = [](const std::string& what)
  {
    Results results;
    results.unusable("layer", "a/b.json", what);
    return results.report().residuals.at(0).worst.value;
  };
  EXPECT_EQ(found("out/a/b.json: no such file"), "no such file");
  EXPECT_EQ(found("a/b.json:7: is not valid"), "line 7: is not valid");
  EXPECT_EQ(found("is damaged"), "is damaged");
  EXPECT_EQ(found("other.json: names a/b.json: no such file"), "other.json: names a/b.json: no such file");
}
} // namespace
