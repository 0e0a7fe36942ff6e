#include "fit/spline_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/test_lights.h"

namespace illum {
namespace {

// The sum as the header states it, with the library's Legendre polynomials.
double directSum(double order, double cosine) {
  double sum = 0, atZero = 0;
  for (unsigned l = 1; l <= 30; ++l) {
    const double coefficient = (2 * l + 1) / std::pow(l * (l + 1.0), order);
    sum += coefficient * std::legendre(l, cosine);
    atZero += coefficient;
  }
  return sum / atZero;
}

TEST(SplineKernel, IsTheStatedSum) {
  for (const double order : {1.25, 1.5, 2.0, 3.0}) {
    const SplineKernel kernel(order);
    for (double cosine = -1; cosine <= 1; cosine += 0.0625) {
      EXPECT_NEAR(kernel(cosine), directSum(order, cosine), 1e-13) << order << " at " << cosine;
    }
    EXPECT_NEAR(kernel(1), 1, 1e-13) << order;
  }
}

TEST(SplineKernel, IsACovariance) {
  const std::vector<Direction> lights = test::randomLights(60, -1);
  for (const double order : {1.25, 2.0, 3.0}) {
    const SplineKernel kernel(order);
    Matrix covariance(60, 60);
    for (int i = 0; i < 60; ++i) {
      for (int j = 0; j < 60; ++j)
        covariance(i, j) = kernel(dot(lights[i].vector(), lights[j].vector()));
    }
    EXPECT_GT(largestEigenPairs(covariance, 60).values[59], -1e-12) << order;
  }
}

TEST(SplineKernel, IsSmootherAtLargerOrders) {
  const double near = std::cos(0.2);
  EXPECT_LT(SplineKernel(1.25)(near), SplineKernel(1.5)(near));
  EXPECT_LT(SplineKernel(1.5)(near), SplineKernel(2)(near));
  EXPECT_LT(SplineKernel(2)(near), SplineKernel(3)(near));
}

}  // namespace
}  // namespace illum
