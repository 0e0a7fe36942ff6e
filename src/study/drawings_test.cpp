#include "study/drawings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "study/evaluation_for_test.h"

namespace illum {
namespace {

using testing::HasSubstr;
using testing::Not;

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

/// Relative luminance of "#rrggbb" (BT.709 on linear light).
double luminance(const std::string& colour) {
  double sum = 0;
  const std::array<double, 3> weights{0.2126, 0.7152, 0.0722};
  for (std::size_t c = 0; c < 3; ++c) {
    const double encoded = std::strtol(colour.substr(1 + 2 * c, 2).c_str(), nullptr, 16) / 255.0;
    sum += weights[c] * std::pow(encoded, 2.2);
  }
  return sum;
}

TEST(Drawings, TheRampGrowsLighterAllTheWay) {
  double last = -1;
  for (int i = 0; i <= 64; ++i) {
    const double now = luminance(rampColour(i / 64.0));
    EXPECT_GT(now, last) << i;
    last = now;
  }
  EXPECT_EQ(rampColour(0), "#440154");
  EXPECT_EQ(rampColour(1), "#fde725");
  EXPECT_EQ(rampColour(-3), rampColour(0));
  EXPECT_EQ(rampColour(7), rampColour(1));
  EXPECT_EQ(rampColour(std::numeric_limits<double>::quiet_NaN()), rampColour(0));
}

TEST(Drawings, TheRangeIsThatOfTheLightsButNeverTiny) {
  const DecibelRange wide = decibelRange(madeUpEvaluation({20, 30, 25}));
  EXPECT_EQ(wide.low, 20);
  EXPECT_EQ(wide.high, 30);
  const DecibelRange narrow = decibelRange(madeUpEvaluation({30, 30.2}));
  EXPECT_NEAR(narrow.high - narrow.low, 3, 1e-12);
  EXPECT_NEAR(narrow.high + narrow.low, 60.2, 1e-12);
  const DecibelRange none = decibelRange(Evaluation());
  EXPECT_LT(none.low, none.high);
}

TEST(Drawings, TheDomeHasXRightAndYUp) {
  Evaluation evaluation = madeUpEvaluation({30, 31, 32, 33});
  evaluation.lights[0].direction = Direction::fromVector({1, 0, 0});
  evaluation.lights[1].direction = Direction::fromVector({0, 1, 0});
  const std::string svg = domeDrawing(evaluation);
  EXPECT_THAT(svg, HasSubstr(R"(<circle class="dot" cx="306.0" cy="160.0")"));
  EXPECT_THAT(svg, HasSubstr(R"(<circle class="dot" cx="160.0" cy="14.0")"));
}

TEST(Drawings, HeldOutLightsAreRinged) {
  const Evaluation evaluation = madeUpEvaluation({30, 31, 32, 33, 34, 35, 36});
  for (const std::string& svg : {domeDrawing(evaluation), lightPlot(evaluation)}) {
    EXPECT_EQ(count(svg, "class=\"dot\""), 7);
    EXPECT_EQ(count(svg, "class=\"ring\""), 2);
    EXPECT_EQ(count(svg, "<title>"), 7);
    EXPECT_EQ(count(svg, "<g>"), count(svg, "</g>"));
  }
}

TEST(Drawings, LightsFromBehindGetADiscOfTheirOwn) {
  Evaluation evaluation = madeUpEvaluation({30, 31, 32});
  EXPECT_EQ(count(domeDrawing(evaluation), "class=\"horizon\""), 1);
  EXPECT_THAT(domeDrawing(evaluation), Not(HasSubstr("from behind")));
  evaluation.lights[1].direction = Direction::fromVector({0, 0, -1});
  const std::string svg = domeDrawing(evaluation);
  EXPECT_EQ(count(svg, "class=\"horizon\""), 2);
  EXPECT_THAT(svg, HasSubstr("from behind"));
  EXPECT_THAT(svg, HasSubstr(R"(class="dot" cx="480.0" cy="160.0")"));
}

TEST(Drawings, HostileNamesStayText) {
  Evaluation evaluation = madeUpEvaluation({30});
  evaluation.lights[0].name = "</title><script>alert(1)</script>";
  EXPECT_THAT(domeDrawing(evaluation), Not(HasSubstr("<script")));
  EXPECT_THAT(lightPlot(evaluation), Not(HasSubstr("<script")));
}

TEST(Drawings, FiguresThatDoNotExistDoNotReachTheDrawing) {
  Evaluation evaluation = madeUpEvaluation({30, 31, 32});
  evaluation.lights[1].all.psnrDecibels = std::numeric_limits<double>::quiet_NaN();
  evaluation.heldOut.all.psnrDecibels = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& svg :
       {domeDrawing(evaluation), lightPlot(evaluation), rampLegend(evaluation),
        domeDrawing(Evaluation()), lightPlot(Evaluation()), rampLegend(Evaluation())}) {
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

TEST(Drawings, ThePlotHasFewGridLinesForEveryRange) {
  for (const double top : {30.5, 34.0, 47.0, 60.0, 99.0}) {
    const std::string svg = lightPlot(madeUpEvaluation({30, top, 31}));
    EXPECT_GE(count(svg, "class=\"grid\""), 2) << top;
    EXPECT_LE(count(svg, "class=\"grid\""), 7) << top;
  }
}

}  // namespace
}  // namespace illum
