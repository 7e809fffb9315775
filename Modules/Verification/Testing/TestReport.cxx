// SPDX-License-Identifier: BSD-3-Clause
// The whole of what a report says, as table, document and lines.
#include "dgtkVerification.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;

constexpr double inf = std::numeric_limits<double>::infinity();

Residual residualOf(const std::string& check, const std::string& layer, std::uint64_t count, std::uint64_t open,
  std::uint64_t bad, double largest, double tolerance)
{
  Residual residual;
  residual.check = check;
  residual.layer = layer;
  residual.unit = layer.empty() ? "" : "pixel";
  residual.count = count;
  residual.skipped = open;
  residual.bad = bad;
  residual.largest = largest;
  residual.tolerance = tolerance;
  residual.mostOpen = 0.125;
  return residual;
}

VerificationReport mixed()
{
  VerificationReport report;
  report.manifestHash = "0123abcd";
  report.residuals.push_back(residualOf("hashes", "", 12, 0, 0, 0, 0));
  report.residuals.push_back(residualOf("flow", "flow_forward", 100, 3, 2, 1.5, 0.001));
  report.residuals.back().worst = { "left/flow_forward/000001.flo", 0, 7, "(1, 2)", "(1, 3.5)" };
  report.residuals.push_back(residualOf("classes", "classes", 50, 1, 1, inf, 0));
  report.residuals.back().worst = { "left/classes/000001.png", -1, -1, "damaged", "a file that can be used" };
  report.residuals.push_back(residualOf("depth", "depth", 10, 90, 0, 0.0000125, 1e-9));
  report.unchecked = { { "color", "png", 4 }, { "notes.txt", "txt", 1 }, { "pov", "pov", 1 } };
  return report;
}

TEST(Report, AsATable)
{
  EXPECT_EQ(verificationTable(mixed()),
    "check    layer         values  open   largest  tolerance  unit\n"
    "hashes                     12     0         0          0         ok\n"
    "flow     flow_forward     100     3  1.50e+00   1.00e-03  pixel  BREACH (2)\n"
    "classes  classes           50     1       inf          0  pixel  BREACH (1)\n"
    "depth    depth             10    90  1.25e-05   1.00e-09  pixel  BREACH (open)\n"
    "not checked beyond their hashes: color .png (4 files), notes.txt (1 file), pov .pov (1 file)\n");
  VerificationReport clean;
  clean.residuals.push_back(residualOf("a", "b", 1, 0, 0, 0.25, 1));
  EXPECT_EQ(verificationTable(clean), "check  layer  values  open   largest  tolerance  unit\n"
                                      "a      b           1     0  2.50e-01   1.00e+00  pixel  ok\n");
}

TEST(Report, NamesOfAnyBytes)
{
  VerificationReport report;
  report.residuals.push_back(residualOf("depth", "de\xe4\npth", 1, 0, 1, 2, 1));
  report.residuals.back().worst = { "l\xe4/x.npy", 1, 2, "\xfc", "\xf6" };
  report.unchecked = { { "no\x1btes\xe4.txt", "txt", 1 } };
  const std::string table = verificationTable(report);
  EXPECT_NE(table.find("\ndepth  de\\xE4\\x0Apth       1 "), std::string::npos) << table;
  EXPECT_NE(table.find(": no\\x1Btes\\xE4.txt (1 file)\n"), std::string::npos) << table;
  const std::string text = verificationText(report);
  for (const char* const part :
    { "\"de\xee\xbf\xa4\\npth\"", "\"l\xee\xbf\xa4/x.npy\"", "\"\xee\xbf\xbc\"", "\"no\\u001btes\xee\xbf\xa4.txt\"" })
  {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
}

TEST(Report, AsADocument)
{
  EXPECT_EQ(verificationText(mixed()), R"json({
  "format": "DGTk verification",
  "format_version": 1,
  "dataset_manifest": "0123abcd",
  "passed": false,
  "residuals": [
    {
      "check": "hashes",
      "layer": "",
      "count": 12,
      "skipped": 0,
      "most_open": 0.125,
      "bad": 0,
      "largest": 0.0,
      "tolerance": 0.0,
      "unit": "",
      "breach": false
    },
    {
      "check": "flow",
      "layer": "flow_forward",
      "count": 100,
      "skipped": 3,
      "most_open": 0.125,
      "bad": 2,
      "largest": 1.5,
      "tolerance": 0.001,
      "unit": "pixel",
      "breach": true,
      "worst": {
        "file": "left/flow_forward/000001.flo",
        "pixel": [
          0,
          7
        ],
        "value": "(1, 2)",
        "expected": "(1, 3.5)"
      }
    },
    {
      "check": "classes",
      "layer": "classes",
      "count": 50,
      "skipped": 1,
      "most_open": 0.125,
      "bad": 1,
      "largest": "inf",
      "tolerance": 0.0,
      "unit": "pixel",
      "breach": true,
      "worst": {
        "file": "left/classes/000001.png",
        "pixel": null,
        "value": "damaged",
        "expected": "a file that can be used"
      }
    },
    {
      "check": "depth",
      "layer": "depth",
      "count": 10,
      "skipped": 90,
      "most_open": 0.125,
      "bad": 0,
      "largest": 1.25e-05,
      "tolerance": 1e-09,
      "unit": "pixel",
      "breach": true
    }
  ],
  "not_checked": [
    {
      "layer": "color",
      "format": "png",
      "files": 4
    },
    {
      "layer": "notes.txt",
      "format": "txt",
      "files": 1
    },
    {
      "layer": "pov",
      "format": "pov",
      "files": 1
    }
  ]
}
)json");
  VerificationReport clean;
  clean.residuals.push_back(residualOf("a", "b", 1, 0, 0, 0.25, 1));
  EXPECT_NE(verificationText(clean).find("\"format_version\": 1,\n  \"passed\": true"), std::string::npos);
}

TEST(Report, AsALine)
{
  std::vector<std::string> lines;
  for (const Residual& residual : mixed().residuals)
  {
    lines.push_back(residual.breach() ? describe(residual) : "");
  }
  EXPECT_EQ(lines,
    (std::vector<std::string>{ "",
      "left/flow_forward/000001.flo: pixel (0, 7): found (1, 2), expected (1, 3.5) (check flow, layer flow_forward, "
      "residual 1.50e+00 pixel against 1.00e-03)",
      "left/classes/000001.png: found damaged, expected a file that can be used (check classes, layer classes)",
      "dataset: 90 of 100 values left open, expected at most 1.25e+01 % (check depth, layer depth)" }));
  Residual whole = residualOf("cameras", "", 3, 0, 1, 0.5, 0.25);
  whole.worst = { "", -1, -1, "2", "3" };
  whole.unit = "unit";
  EXPECT_EQ(describe(whole), "dataset: found 2, expected 3 (check cameras, residual 5.00e-01 unit against 2.50e-01)");
  whole.worst = { "cameras.json", 0, 0, "2", "3" };
  EXPECT_EQ(describe(whole).substr(0, 40), "cameras.json: pixel (0, 0): found 2, exp");
}

/// Sixteen values of any picture, and a share of all of them.
TEST(Report, WhatMayBeLeftOpen)
{
  for (const auto& [count, open, tooMuch] : { std::tuple(0, 16, false), std::tuple(0, 18, false),
         std::tuple(0, 19, true), std::tuple(100, 32, false), std::tuple(100, 33, true), std::tuple(0, 0, false) })
  {
    const Residual residual = residualOf("a", "b", std::uint64_t(count), std::uint64_t(open), 0, 0, 0);
    EXPECT_EQ(residual.tooMuchOpen(), tooMuch) << count << ' ' << open;
    EXPECT_EQ(residual.breach(), tooMuch);
  }
  EXPECT_TRUE(residualOf("a", "b", 5, 0, 1, 1, 0).breach());
  const std::vector<std::string> checks = verificationChecks();
  EXPECT_EQ(checks.front(), "hashes");
  EXPECT_GT(checks.size(), 10u);
}
} // namespace
