#include "build/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace illum {
namespace {

TEST(FillHidden, LeavesCoveredTexelsAlone) {
  const Size size{13, 7};
  std::vector<float> planes(2 * size.pixels()), coverage(size.pixels(), 1.0f);
  for (std::size_t i = 0; i < planes.size(); ++i) planes[i] = static_cast<float>(i % 17) - 5;
  for (std::size_t i = 0; i < coverage.size(); i += 3) coverage[i] = 0;
  const auto before = planes;
  fillHidden(planes, coverage, size);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (coverage[i % size.pixels()] > 0) {
      EXPECT_EQ(planes[i], before[i]) << i;
    }
  }
}

TEST(FillHidden, ContinuesAConstantExactly) {
  const Size size{31, 18};
  std::vector<float> planes(size.pixels(), 99.0f), coverage(size.pixels(), 0.0f);
  for (int y = 5; y < 9; ++y) {
    for (int x = 3; x < 20; ++x) {
      const auto i = static_cast<std::size_t>(y * size.width + x);
      planes[i] = 0.25f;
      coverage[i] = 0.5f;
    }
  }
  fillHidden(planes, coverage, size);
  for (const float p : planes) EXPECT_NEAR(p, 0.25f, 1e-6f);
}

TEST(FillHidden, StaysWithinTheRangeOfWhatIsSeen) {
  const Size size{40, 40};
  std::vector<float> planes(size.pixels()), coverage(size.pixels(), 0.0f);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const auto i = static_cast<std::size_t>(y * 40 + x);
      const bool seen = std::hypot(x - 20, y - 20) < 9;
      planes[i] = seen ? static_cast<float>(x) : 1e6f;
      coverage[i] = seen ? 1.0f : 0.0f;
    }
  }
  fillHidden(planes, coverage, size);
  const auto [low, high] = std::minmax_element(planes.begin(), planes.end());
  EXPECT_GE(*low, 12);
  EXPECT_LE(*high, 28);
}

TEST(FillHidden, NothingSeenBecomesZero) {
  const Size size{5, 4};
  std::vector<float> planes(3 * size.pixels(), 7.0f);
  fillHidden(planes, std::vector<float>(size.pixels(), 0.0f), size);
  for (const float p : planes) EXPECT_EQ(p, 0);
}

}  // namespace
}  // namespace illum
