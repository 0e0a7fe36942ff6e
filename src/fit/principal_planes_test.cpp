#include "fit/principal_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "fit/test_lights.h"
#include "fit/test_stack.h"

namespace illum {
namespace {

struct Scene {
  std::vector<Direction> lights;
  ChannelMoments moments;
};

Scene scene(int count, bool shuffled = false) {
  std::vector<Direction> lights = test::randomLights(count, 0.1);
  if (shuffled) std::shuffle(lights.begin(), lights.end(), std::mt19937(2));
  const std::vector<float> samples = test::shinySamples(lights, 400);
  return {lights, channelMoments(test::statisticsOf(samples, count))};
}

TEST(PrincipalPlanes, AllOfThemAreTheInterpolatedPicture) {
  const Scene s = scene(15);
  const Kriging kriging(s.lights, {1.5, 0, 1e-4});
  const PrincipalPlanes planes = principalPlanes(kriging, s.lights, s.moments, 45);
  const Matrix w = kriging.weightsAt(test::randomLights(20, 0, 6));
  for (int c = 0; c < 3; ++c) {
    const Matrix rebuilt = w * planes.functions.middleRows(15 * c, 15) * planes.analysis;
    Matrix expected = Matrix::Zero(20, 45);
    expected.middleCols(15 * c, 15) = w;
    EXPECT_LT((rebuilt - expected).cwiseAbs().maxCoeff(), 1e-4) << "channel " << c;
  }
}

TEST(PrincipalPlanes, AreUncorrelatedAndOfFallingVariance) {
  const Scene s = scene(20);
  const Kriging kriging(s.lights, {2, 1, 1e-2});
  const PrincipalPlanes planes = principalPlanes(kriging, s.lights, s.moments, 12);
  const Matrix covariance = planes.analysis * s.moments.covariance * planes.analysis.transpose();
  const Matrix expected = planes.variances.asDiagonal();
  EXPECT_LT((covariance - expected).cwiseAbs().maxCoeff(), 1e-9 * planes.variances[0]);
  for (int k = 1; k < 12; ++k) EXPECT_LE(planes.variances[k], planes.variances[k - 1]) << k;
}

TEST(PrincipalPlanes, MoreThanThereAreIsCut) {
  const Scene s = scene(4);
  const Kriging kriging(s.lights, {2, 0, 1e-2});
  EXPECT_EQ(principalPlanes(kriging, s.lights, s.moments, 100).variances.size(), 12);
}

TEST(ChoosePlaneCount, IsAMultipleOfThreeWithinTheLimit) {
  for (const int count : {3, 9, 10, 25, 40}) {
    const Scene s = scene(count);
    const int planes = choosePlaneCount(s.lights, s.moments, {2, 0, 1e-3});
    EXPECT_EQ(planes % 3, 0) << count;
    EXPECT_GE(planes, 3) << count;
    EXPECT_LE(planes, std::min(3 * count, kGreatestDefaultPlanes)) << count;
  }
}

TEST(ChoosePlaneCount, DoesNotDependOnTheOrderOfTheLights) {
  const Scene a = scene(30), b = scene(30, true);
  EXPECT_EQ(choosePlaneCount(a.lights, a.moments, {2, 1, 1e-3}),
            choosePlaneCount(b.lights, b.moments, {2, 1, 1e-3}));
}

TEST(ChoosePlaneCount, AMattePictureNeedsFew) {
  const std::vector<Direction> lights = test::randomLights(40, 0.7);
  std::vector<float> samples = test::shinySamples(lights, 300);
  // Without the highlight and the shadows: nine planes, three per colour, carry everything.
  for (std::size_t l = 0; l < lights.size(); ++l) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t p = 0; p < 300; ++p) {
        const double a = 0.001 * static_cast<double>(p), b = 0.3 + 0.1 * static_cast<double>(c);
        const Vector3 v = lights[l].vector();
        samples[(3 * l + c) * 300 + p] = static_cast<float>(a * v.x + b * v.y + v.z * (1 - a));
      }
    }
  }
  const ChannelMoments moments = channelMoments(test::statisticsOf(samples, 40));
  EXPECT_LE(choosePlaneCount(lights, moments, {2, 1, 1e-3}), 9);
}

}  // namespace
}  // namespace illum
