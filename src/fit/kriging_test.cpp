#include "fit/kriging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/bases/light_basis_family.h"
#include "fit/leave_one_out.h"
#include "fit/test_lights.h"

namespace illum {
namespace {

TEST(Kriging, ReproducesTheTrendExactly) {
  const std::vector<Direction> lights = test::randomLights(25, 0),
                               where = test::randomLights(40, -1, 5);
  for (int order = 0; order <= 2; ++order) {
    const int functions = (order + 1) * (order + 1);
    const auto harmonics =
        analyticBasis(BasisFamily::SphericalHarmonics, functions, LightDomain::Sphere);
    const Kriging kriging(lights, {1.5, order, 0.03});
    std::vector<double> row(functions);
    Matrix atLights(25, functions), expected(40, functions);
    for (int i = 0; i < 25; ++i) {
      harmonics->evaluate(lights[i], row);
      atLights.row(i) = Eigen::Map<Eigen::RowVectorXd>(row.data(), functions);
    }
    for (int i = 0; i < 40; ++i) {
      harmonics->evaluate(where[i], row);
      expected.row(i) = Eigen::Map<Eigen::RowVectorXd>(row.data(), functions);
    }
    const Matrix predicted = kriging.weightsAt(where) * atLights;
    EXPECT_LT((predicted - expected).cwiseAbs().maxCoeff(), 1e-8) << "trend of order " << order;
  }
}

TEST(Kriging, WeightsAddUpToOne) {
  const std::vector<Direction> lights = test::randomLights(20, 0.2);
  std::vector<double> weights(20);
  for (const Direction& d : test::randomLights(30, -1, 9)) {
    Kriging(lights, {2, 1, 1e-3}).weights(d, weights);
    double sum = 0;
    for (const double w : weights) sum += w;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST(Kriging, WithoutNoiseItInterpolates) {
  const std::vector<Direction> lights = test::randomLights(20, 0.1);
  for (const double order : {1.25, 1.5, 2.0}) {
    const Matrix w = Kriging(lights, {order, 1, 0}).weightsAt(lights);
    EXPECT_LT((w - Matrix::Identity(20, 20)).cwiseAbs().maxCoeff(), 1e-5) << order;
  }
}

TEST(Kriging, TheOrderOfTheLightsDoesNotMatter) {
  std::vector<Direction> lights = test::randomLights(20, 0.1);
  const std::vector<Direction> where = test::randomLights(10, 0, 4);
  Matrix before = Kriging(lights, {1.5, 1, 1e-2}).weightsAt(where);
  std::reverse(lights.begin(), lights.end());
  const Matrix after = Kriging(lights, {1.5, 1, 1e-2}).weightsAt(where);
  before = before.rowwise().reverse().eval();
  EXPECT_LT((before - after).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Kriging, LightsInTheSameDirectionShareTheirWeight) {
  std::vector<Direction> lights = test::randomLights(12, 0.1);
  lights.push_back(lights[4]);
  const Matrix w = Kriging(lights, {2, 0, 1e-3}).weightsAt(test::randomLights(10, 0, 4));
  EXPECT_TRUE(w.allFinite());
  EXPECT_LT((w.col(4) - w.col(12)).cwiseAbs().maxCoeff(), 1e-6);
}

// Kriging from all other lights at each in turn.
Vector refittedErrors(const std::vector<Direction>& lights, const KrigingModel& model,
                      const Matrix& samples) {
  Vector errors(samples.rows());
  for (std::size_t left = 0; left < lights.size(); ++left) {
    std::vector<Direction> others = lights;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    std::vector<double> weights(others.size());
    Kriging(others, model).weights(lights[left], weights);
    Eigen::RowVectorXd error = samples.row(left);
    for (std::size_t i = 0; i < others.size(); ++i) {
      error -= weights[i] * samples.row(i < left ? i : i + 1);
    }
    errors[left] = error.squaredNorm() / static_cast<double>(samples.cols());
  }
  return errors;
}

TEST(Kriging, ClosedFormIsWhatKrigingAgainGives) {
  const std::vector<Direction> lights = test::randomLights(24, 0.1);
  const Matrix samples = Matrix::Random(24, 30);
  const Matrix gram = samples * samples.transpose() / 30;
  const std::array nuggets{1e-4, 1e-2, 1.0};
  for (int trend = 0; trend <= 2; ++trend) {
    const Matrix closed = krigingLeaveOneOut(lights, 1.5, trend, nuggets, gram);
    for (int j = 0; j < 3; ++j) {
      const Vector direct = refittedErrors(lights, {1.5, trend, nuggets[j]}, samples);
      EXPECT_LT(((closed.col(j) - direct).array() / direct.array()).abs().maxCoeff(), 1e-6)
          << "trend " << trend << ", nugget " << nuggets[j];
    }
  }
}

TEST(Kriging, TrendsThatTheLightsCannotTellApartAreNotTried) {
  std::vector<Direction> ring;
  for (int i = 0; i < 20; ++i) ring.push_back(Direction::fromAngles(0.8, 0.3 * i - 3));
  EXPECT_TRUE(trendIsSupported(ring, 0));
  EXPECT_FALSE(trendIsSupported(ring, 1)) << "on a ring z is constant";
  EXPECT_FALSE(trendIsSupported(test::randomLights(4, 0), 1)) << "no light left to judge by";
  EXPECT_TRUE(trendIsSupported(test::randomLights(5, 0), 1));
}

TEST(ChooseKriging, FindsASmoothModelForSmoothPictures) {
  const std::vector<Direction> lights = test::randomLights(40, 0.1);
  Matrix samples(40, 3);  // linear in the direction, as a matte surface is
  for (int i = 0; i < 40; ++i) samples.row(i) << lights[i].x(), lights[i].y(), lights[i].z();
  const KrigingChoice choice =
      chooseKriging(lights, samples * samples.transpose(), LightDomain::Hemisphere, std::nullopt);
  EXPECT_GE(choice.model.trendOrder, 1);
  EXPECT_GT(meanDecibels(choice.errors), 100);
}

TEST(ChooseKriging, StaysSaneFarBeyondANarrowCap) {
  const std::vector<Direction> lights = test::randomLights(20, 0.9);
  const Matrix gram = test::randomGram(20);
  const KrigingChoice choice = chooseKriging(lights, gram, LightDomain::Hemisphere, std::nullopt);
  const Matrix w = Kriging(lights, choice.model).weightsAt(test::randomLights(200, 0, 8));
  EXPECT_LE(std::sqrt(w.rowwise().squaredNorm().maxCoeff()), 5.5);
}

TEST(ChooseKriging, AnyNumberOfLightsWillDo) {
  for (int count = 1; count <= 12; ++count) {
    const std::vector<Direction> lights = test::randomLights(count, 0.2);
    const KrigingChoice choice =
        chooseKriging(lights, test::randomGram(count), LightDomain::Hemisphere, std::nullopt);
    EXPECT_EQ(choice.errors.size(), count);
    EXPECT_TRUE(Kriging(lights, choice.model).weightsAt(lights).allFinite()) << count;
  }
}

TEST(ChooseKriging, KeepsAGivenNugget) {
  const KrigingChoice choice = chooseKriging(test::randomLights(15, 0.2), test::randomGram(15),
                                             LightDomain::Hemisphere, 0.123);
  EXPECT_EQ(choice.model.nugget, 0.123);
}

}  // namespace
}  // namespace illum
