// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkPovEvaluator.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dgtk;
using testing::ElementsAre;
using testing::HasSubstr;

// Values of the scene description language by themselves: no shapes, no directives.

namespace
{
struct Reading
{
  explicit Reading(const std::string& written)
    : stream((writeFile(this->folder.path("values.pov"), written), this->folder.path("values.pov")))
    , evaluator(stream, symbols)
  {
    PovValue color;
    color.number = { { 0.25, 0.5, 0.75, 0, 0 }, 5, true, nullptr };
    this->symbols.declare("Slate", color);
    PovValue vector;
    vector.number = { { 1, 2, 3 }, 3, false, nullptr };
    this->symbols.declare("V", vector);
    PovValue text;
    text.kind = PovValue::Kind::Text;
    this->symbols.declare("Name", text);
    this->symbols.poison({ "Lost" }, { 0, 7 }, "#while is not evaluated");
  }

  dgtk::test::TemporaryFolder folder;
  PovStream stream;
  PovSymbols symbols;
  PovEvaluator evaluator;
};

PovNumber logical(const std::string& text) { return Reading(text).evaluator.logical(); }
} // namespace

TEST(PovEvaluator, AnExpressionEndsBeforeAComparison)
{
  Reading reading("1 + 2 * 3 < 2");
  EXPECT_EQ(reading.evaluator.expression().v[0], 7);
  EXPECT_TRUE(reading.stream.accept('<'));
  EXPECT_EQ(logical("1 + 2 * 3 < 2").v[0], 0);
  EXPECT_EQ(logical("1 < 2 & 3 >= 3 ? 10 : 20").v[0], 10);
}

TEST(PovEvaluator, AFloatIsAVectorThatHasItInAllComponents)
{
  EXPECT_EQ(Reading("5").evaluator.vector("a place"), Eigen::Vector3d(5, 5, 5));
  EXPECT_EQ(Reading("2 * V + y").evaluator.vector("a place"), Eigen::Vector3d(2, 5, 6));
  EXPECT_EQ(Reading("V.z").evaluator.scalar(), 3);
}

TEST(PovEvaluator, VectorsAreComparedComponentByComponent)
{
  EXPECT_THAT(logical("<1, 2, 5> != <1, 3, 4>").v, ElementsAre(0, 1, 1, 0, 0));
  EXPECT_THAT(logical("<1, 2, 5> <= <1, 3, 4>").v, ElementsAre(1, 1, 0, 0, 0));
  EXPECT_THAT(logical("<1, 2, 5> >= <1, 3, 4>").v, ElementsAre(1, 0, 1, 0, 0));
}

TEST(PovEvaluator, ColoursAndWhatIsSaidBehindThem)
{
  const std::pair<const char*, std::array<double, 5>> table[] = { { "rgb 0.5", { 0.5, 0.5, 0.5, 0, 0 } },
    { "rgbt <1, 2, 3, 4>", { 1, 2, 3, 0, 4 } }, { "rgbf <1, 2, 3, 4>", { 1, 2, 3, 4, 0 } },
    { "color Slate", { 0.25, 0.5, 0.75, 0, 0 } }, { "Slate transmit 0.5", { 0.25, 0.5, 0.75, 0, 0.5 } },
    { "red 1 blue 0.5", { 1, 0, 0.5, 0, 0 } }, { "rgb <1, 1, 1> green 0 filter 0.25", { 1, 0, 1, 0.25, 0 } } };
  for (const auto& [text, expected] : table)
  {
    const PovNumber found = logical(text);
    EXPECT_TRUE(found.isKnownColor()) << text;
    EXPECT_THAT(found.v, testing::ElementsAreArray(expected)) << text;
  }
}

TEST(PovEvaluator, FunctionsHaveTheValuesThatPovRayHas)
{
  const std::pair<const char*, std::vector<double>> table[] = { // as POV-Ray 3.7 writes them with `#debug`
    { "<pow(-2, 3), pow(2, -1), mod(-5, 3)>", { -8, 0.5, -2 } },
    { "<mod(5.5, -2), div(-7, 2), int(-2.5)>", { 1.5, -3, -2 } },
    { "<floor(-2.5), ceil(-2.5), atan2(1, -1)>", { -3, -2, 2.356194490192 } },
    { "<log(1000), ln(2), exp(1)>", { 3, 0.693147180560, 2.718281828459 } },
    { "<select(-1, 5, 6), select(0, 5, 6), select(1, 5, 6)>", { 5, 6, 6 } },
    { "<select(0, 5, 6, 7), select(2, 5, 6, 7), select(-2, 5, 6, 7)>", { 6, 7, 5 } },
    { "<vlength(2), vdot(<1, 2, 3>, 2), degrees(pi)>", { 3.464101615138, 12, 180 } },
    { "<acos(-0.5), asin(-0.5), tan(1)>", { 2.094395102393, -0.523598775598, 1.557407724655 } },
    { "<max(1, 3, 2), min(4, 2, 3), sqrt(2)>", { 3, 2, 1.414213562373 } },
    { "<pow(0, 1), pow(2, 0.5), radians(90)>", { 0, 1.414213562373, 1.570796326795 } },
    { "<abs(-2), sin(1), cos(1)>", { 2, 0.841470984808, 0.540302305868 } },
    { "vaxis_rotate(<1, 2, 3>, <0, 0, 2>, 90)", { -2, 1, 3 } },
    { "vaxis_rotate(<1, 2, 3>, <1, 1, 0>, 30)", { 2.127647469888, 0.872352530112, 2.951629601947 } },
    { "vrotate(<1, 2, 3>, <90, 30, 0>)", { 1.866025403784, -3, 1.232050807569 } }, { "2 * vcross(x, y)", { 0, 0, 2 } },
    { "vnormalize(<3, 0, 4>).z + max(1, V.x)", { 1.8 } }
  };
  for (const auto& [text, expected] : table)
  {
    const PovNumber found = logical(text);
    ASSERT_FALSE(found.unknown) << text;
    ASSERT_EQ(found.size, int(expected.size())) << text;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_NEAR(found.v[i], expected[i], 1e-12) << text;
    }
  }
  for (const char* text : { "sqrt(-1)", "pow(-2, 0.5)", "pow(0, 0)", "ln(0)", "mod(1, 0)", "acos(2)" })
  {
    const PovNumber found = logical(text);
    ASSERT_TRUE(found.unknown) << text;
    EXPECT_THAT(found.unknown->what, HasSubstr("has no value here")) << text;
  }
  EXPECT_EQ(logical("1 + max(2, Lost)").unknown->place.line, 7);
  EXPECT_THAT(test::thrownBy<InputError>([] { logical("pow(2)"); }),
    HasSubstr("function 'pow' has a wrong number of arguments (expected 2, found 1)"));
  EXPECT_THROW(logical("max(1 2)"), InputError);
  EXPECT_THROW(logical("max()"), InputError);
}

TEST(PovEvaluator, WhatIsNotKnownSaysWhyAndIsReadToItsEnd)
{
  const std::pair<const char*, const char*> table[] = {
    { "1 + f(2, <3>) * 4", "function or macro 'f' is not evaluated" }, { "Missing", "undeclared name 'Missing'" },
    { "Name", "'Name' is not a number" }, { "2 / (1 - 1)", "division by zero" },
    { "<1, Lost, 3>", "#while is not evaluated" }, { "rgb Lost", "#while is not evaluated" },
    { "Lost[2](3)", "#while is not evaluated" }, { "function(x) { x }", "function is not evaluated" },
    { "array[2] { 1, 2 }", "array is not evaluated" }, { "Lost < 2", "#while is not evaluated" }
  };
  for (const auto& [text, why] : table)
  {
    Reading reading(text);
    const PovNumber found = reading.evaluator.logical();
    ASSERT_TRUE(found.unknown) << text;
    EXPECT_EQ(found.unknown->what, why) << text;
    EXPECT_EQ(reading.stream.peek().kind, PovToken::Kind::End) << text;
  }
  EXPECT_EQ(logical("\n1 +\nMissing").unknown->place.line, 3);
  EXPECT_EQ(logical("Lost").unknown->place.line, 7);
  EXPECT_EQ(logical("1 ? 2 : Missing").v[0], 2) << "only what is chosen has to be known";
}

TEST(PovEvaluator, WhatHasToBeKnownIsRefusedWhereItStands)
{
  EXPECT_THAT(test::thrownBy<InputError>([&] { Reading("\n1 + Lost").evaluator.scalar(); }),
    HasSubstr("values.pov:7: #while is not evaluated, and a mesh depends on it (line 2)"))
    << "not refused";
  EXPECT_THROW(Reading("}").evaluator.vector("a triangle"), InputError);
  EXPECT_THROW(logical(""), InputError);
  EXPECT_THROW(logical(std::string(200, '(') + "1" + std::string(200, ')')), InputError);
}

TEST(PovEvaluator, AnOptionalValueIsLeftWhereNoneBegins)
{
  PovNumber value;
  Reading none("phong 0.5");
  EXPECT_FALSE(none.evaluator.optional(value));
  EXPECT_TRUE(none.stream.accept("phong"));
  EXPECT_TRUE(none.evaluator.optional(value));
  EXPECT_EQ(value.v[0], 0.5);
  EXPECT_FALSE(Reading("Lost").evaluator.optional(value));
}

TEST(PovEvaluator, TransformsFollowOneAnother)
{
  Reading reading("scale 2 translate x rotate 90*z sphere");
  Eigen::Affine3d total = Eigen::Affine3d::Identity();
  while (reading.evaluator.transform(total))
  {
  }
  EXPECT_EQ(total * Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(-2, 3, 0)) << "quarter turns are exact";
  EXPECT_TRUE(reading.stream.accept("sphere"));
}
