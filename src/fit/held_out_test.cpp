// How well photographs that the default fit has not seen are predicted (docs/math/fitting.md,
// "Figures").
#include <gtest/gtest.h>

#include <iostream>
#include <numeric>

#include "fit/test_stack.h"

namespace illum {
namespace {

struct Expectation {
  const char* stack;
  double held;  ///< dB, a little below what is reached
};

void PrintTo(const Expectation& e, std::ostream* out) {
  *out << e.stack;
}

void report(const char* stack, const Fit& fit, double used, double held) {
  std::cout << stack << ": " << fit.basis.planes() << " planes, used " << used << ", held out "
            << held << ", expected at an unseen light " << fit.leaveOneOutDecibels << " dB";
  for (const std::string& choice : fit.choices) std::cout << "; " << choice;
  std::cout << '\n';
}

class HeldOut : public testing::TestWithParam<Expectation> {};

TEST_P(HeldOut, EveryFifthPhotographIsPredicted) {
  const auto stack = test::sharedStack(GetParam().stack);
  if (!stack) GTEST_SKIP() << "no " << GetParam().stack << " under " << test::sharedFolder();
  const test::Figures figures = test::fitAndJudge(*stack, {}, 5);
  report(GetParam().stack, figures.fit, figures.used, figures.held);
  EXPECT_GE(figures.held, GetParam().held);
  EXPECT_GE(figures.used, figures.held);
  EXPECT_TRUE(figures.fit.warnings.empty());
}

INSTANTIATE_TEST_SUITE_P(Stacks, HeldOut,
                         testing::Values(Expectation{"realrti01_door/stack", 37.8},
                                         Expectation{"realrti03_icon_michele/stack", 24.3},
                                         Expectation{"realrti08_clay_shell/stack", 34.6},
                                         Expectation{"realrti09_coin_a/stack", 25.6},
                                         Expectation{"realrti11_metal_statue_a/stack", 32.7},
                                         Expectation{"diligent_cat/stack", 32.0},
                                         Expectation{"harvardps_scholar/stack", 18.5}));

TEST(HeldOut, LightsBetweenThoseOfARenderedDomeArePredicted) {
  const char* name = "synthrti_single_object2_m6/stack";
  const auto dome = test::sharedStack(name),
             between = test::sharedStack(std::string(name) + "_test");
  if (!dome || !between) GTEST_SKIP() << "no " << name << " under " << test::sharedFolder();
  const test::Figures figures = test::fitAndJudge(*dome, {}, 0);
  std::vector<int> all(dome->lights.size()), judged(between->lights.size());
  std::iota(all.begin(), all.end(), 0);
  std::iota(judged.begin(), judged.end(), 0);
  std::vector<float> planes(figures.fit.basis.planes() * dome->pixels);
  figures.fit.planes.apply(dome->read(all), dome->pixels, planes);
  const double held = test::relitDecibels(figures.fit, planes, *between, judged);
  report(name, figures.fit, figures.used, held);
  EXPECT_GE(held, 27.8);
}

}  // namespace
}  // namespace illum
