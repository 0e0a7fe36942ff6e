// Plain ridge fits of public photograph stacks, made independently
// (shared/peers/reference-fits.tsv).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "fit/test_stack.h"

namespace illum {
namespace {

struct ReferenceRow {
  std::string stack;
  FitOptions options;
  std::string text;
  double used = 0, used80 = 0, held = 0;
};

// The rows of the families that exist here.
std::vector<ReferenceRow> referenceRows() {
  const std::map<std::string, BasisFamily> families{{"sh", BasisFamily::SphericalHarmonics},
                                                    {"hsh", BasisFamily::HemisphericalHarmonics},
                                                    {"dct", BasisFamily::Cosine}};
  std::ifstream file(test::sharedFolder() / "peers" / "reference-fits.tsv");
  std::vector<ReferenceRow> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    ReferenceRow row;
    std::string family;
    fields >> row.stack >> family >> row.options.coefficients;
    if (!fields || !families.contains(family)) continue;
    fields >> row.used >> row.used80 >> row.held;
    row.options.family = families.at(family);
    row.options.regularizer = 1e-3;
    row.options.solidAngleWeights = row.options.extension = false;
    row.text = row.stack + " " + family + " " + std::to_string(row.options.coefficients);
    rows.push_back(row);
  }
  return rows;
}

// One test a stack, for they take long.
const std::vector<std::string> kStacks{"realrti01_door", "realrti03_icon_michele",
                                       "realrti08_clay_shell", "realrti09_coin_a",
                                       "realrti11_metal_statue_a"};

TEST(ReferenceFitsList, AreOfTheseStacks) {
  for (const ReferenceRow& row : referenceRows())
    EXPECT_NE(std::find(kStacks.begin(), kStacks.end(), row.stack), kStacks.end()) << row.stack;
}

class ReferenceFits : public testing::TestWithParam<std::string> {};

TEST_P(ReferenceFits, AreReproducedToATenthOfADecibel) {
  std::vector<ReferenceRow> rows = referenceRows();
  if (rows.empty()) GTEST_SKIP() << "no reference-fits.tsv under " << test::sharedFolder();
  std::erase_if(rows, [](const ReferenceRow& row) { return row.stack != GetParam(); });
  ASSERT_FALSE(rows.empty());
  const std::optional<test::Stack> stack = test::sharedStack(GetParam() + "/stack");
  ASSERT_TRUE(stack) << "no photographs of " << GetParam();
  for (const ReferenceRow& row : rows) {
    const test::Figures all = test::fitAndJudge(*stack, row.options, 0);
    const test::Figures most = test::fitAndJudge(*stack, row.options, 5);
    EXPECT_NEAR(all.used, row.used, 0.1) << row.text;
    EXPECT_NEAR(most.used, row.used80, 0.1) << row.text;
    EXPECT_NEAR(most.held, row.held, 0.1) << row.text;
  }
}

INSTANTIATE_TEST_SUITE_P(Stacks, ReferenceFits, testing::ValuesIn(kStacks),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace illum
