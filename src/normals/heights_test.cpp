#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <limits>

#include "illum/error.h"
#include "illum/normals.h"
#include "normals/grid_laplacian.h"

namespace illum {
namespace {

using Surface = std::function<double(double, double)>;

/// Of z = f(x, y) at the pixels of a photograph, by central differences.
Picture normalsOf(Size size, const Surface& f) {
  Picture normals(size, 3);
  const double side = 2.0 / std::max(size.width, size.height), h = 1e-5;
  for (int j = 0; j < size.height; ++j) {
    for (int i = 0; i < size.width; ++i) {
      const double x = side * (i + 0.5 - size.width / 2.0),
                   y = side * (size.height / 2.0 - j - 0.5);
      const double p = (f(x + h, y) - f(x - h, y)) / (2 * h);
      const double q = (f(x, y + h) - f(x, y - h)) / (2 * h);
      const double s = 1 / std::sqrt(1 + p * p + q * q);
      normals.at(i, j, 0) = static_cast<float>(-p * s);
      normals.at(i, j, 1) = static_cast<float>(-q * s);
      normals.at(i, j, 2) = static_cast<float>(s);
    }
  }
  return normals;
}

/// The largest difference to f, up to a constant, where there are normals.
double largestError(const Picture& heights, const Picture& normals, const Surface& f) {
  const Size size = heights.size();
  const double side = 2.0 / std::max(size.width, size.height);
  double lowest = 1e30, highest = -1e30;
  for (int j = 0; j < size.height; ++j) {
    for (int i = 0; i < size.width; ++i) {
      if (normals.at(i, j, 2) == 0) continue;
      const double x = side * (i + 0.5 - size.width / 2.0),
                   y = side * (size.height / 2.0 - j - 0.5);
      const double difference = heights.at(i, j, 0) - f(x, y);
      lowest = std::min(lowest, difference);
      highest = std::max(highest, difference);
    }
  }
  return (highest - lowest) / 2;
}

double meanOf(const Picture& heights) {
  double sum = 0;
  for (const float z : heights.samples()) sum += z;
  return sum / static_cast<double>(heights.size().pixels());
}

TEST(Heights, APlaneIsAPlane) {
  const Surface plane = [](double x, double y) { return 0.3 * x - 0.7 * y; };
  for (const Size size : {Size{64, 48}, {37, 91}, {200, 3}, {1, 40}, {5, 1}}) {
    const Picture normals = normalsOf(size, plane);
    const Picture heights = photographHeights(normals);
    EXPECT_LT(largestError(heights, normals, plane), 1e-5) << size.width << 'x' << size.height;
    EXPECT_NEAR(meanOf(heights), 0, 1e-6);
  }
}

TEST(Heights, MarginsAreFree) {
  // Not periodic: what Frankot and Chellappa's integration by Fourier series bends.
  const Surface bowl = [](double x, double y) { return 0.5 * x * x + 0.2 * y + 0.1 * x * y; };
  const Picture normals = normalsOf({120, 80}, bowl);
  EXPECT_LT(largestError(photographHeights(normals), normals, bowl), 1e-4);
}

TEST(Heights, ErrorFallsWithTheSquareOfThePixel) {
  const Surface waves = [](double x, double y) {
    return 0.1 * std::sin(7 * x + 1) * std::cos(5 * y);
  };
  double before = 0;
  for (const int n : {32, 64, 128}) {
    const Picture normals = normalsOf({n, n}, waves);
    const double error = largestError(photographHeights(normals), normals, waves);
    if (before > 0) {
      EXPECT_GT(before / error, 3) << n;
      EXPECT_LT(before / error, 5) << n;
    }
    before = error;
  }
}

TEST(Heights, WhatTheMaskHidesDoesNotBendTheRest) {
  const Surface ball = [](double x, double y) {
    return std::sqrt(std::max(0.0, 0.8 * 0.8 - x * x - y * y));
  };
  Picture normals = normalsOf({128, 128}, ball);
  for (int j = 0; j < 128; ++j) {
    for (int i = 0; i < 128; ++i) {
      const double r = std::hypot(i - 63.5, j - 63.5) / 64;
      if (r < 0.7) continue;
      for (int c = 0; c < 3; ++c) normals.at(i, j, c) = 0;
    }
  }
  const Picture heights = photographHeights(normals);
  EXPECT_LT(largestError(heights, normals, ball), 2e-3);
  for (const float z : heights.samples()) EXPECT_TRUE(std::isfinite(z));
}

TEST(Heights, FollowTheUnitOfThePixel) {
  const Picture normals = normalsOf({20, 20}, [](double x, double) { return 0.4 * x; });
  const Picture one = integrateHeights(normals, 1), three = integrateHeights(normals, 3);
  EXPECT_NEAR(one.at(19, 7, 0) - one.at(0, 7, 0), 19 * 0.4, 1e-4);
  EXPECT_NEAR(three.at(19, 7, 0) - three.at(0, 7, 0), 3 * 19 * 0.4, 3e-4);
}

TEST(Heights, AreTheSameOnAnyNumberOfThreads) {
  const Picture normals =
      normalsOf({90, 70}, [](double x, double y) { return 0.2 * std::sin(9 * x * y); });
  const Picture many = photographHeights(normals);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(photographHeights(normals), many);
}

TEST(Heights, RefuseWhatAreNoNormals) {
  EXPECT_THROW(integrateHeights(Picture({4, 4}, 1), 1), Error);
  EXPECT_THROW(integrateHeights(Picture(), 1), Error);
  Picture normals({4, 4}, 3);
  normals.at(1, 1, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(integrateHeights(normals, 1), Error);
}

TEST(GridLaplacian, IsSolvedInFewStepsAtAnySize) {
  for (const int n : {33, 128, 512}) {
    GridEdges edges{{n, n}, std::vector<float>(Size{n, n}.pixels()), {}};
    edges.down = edges.right;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const std::size_t i = Size{n, y}.pixels() + static_cast<std::size_t>(x);
        const float weight = (x / 16 + y / 16) % 2 == 0 ? 1.0F : 0.01F;  // as under a mask
        edges.right[i] = x + 1 < n ? weight : 0;
        edges.down[i] = y + 1 < n ? weight : 0;
      }
    }
    std::vector<double> truth(edges.size.pixels()), right(truth.size()), z(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      truth[i] = std::sin(0.01 * static_cast<double>(i % 1009)) + static_cast<double>(i) / 1e4;
    applyLaplacian(edges, truth, right);
    const int steps = solveLaplacian(edges, right, z, 1e-9, 400);
    EXPECT_LT(steps, 60) << n;
    const double shift = z[0] - truth[0];
    for (std::size_t i = 0; i < truth.size(); i += 97)
      ASSERT_NEAR(z[i] - shift, truth[i], 1e-4) << n << ", pixel " << i;
    RecordProperty("steps" + std::to_string(n), steps);
  }
}

}  // namespace
}  // namespace illum
