#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/bases/light_basis_family.h"
#include "fit/quadrature.h"

namespace illum {
namespace {

using std::numbers::pi;

std::vector<double> valuesAt(const AnalyticBasis& basis, Direction d) {
  std::vector<double> values(basis.coefficients());
  basis.evaluate(d, values);
  return values;
}

// In the stretched cosine c' = 2c - 1 products are polynomials times integer powers of the
// azimuth's cosine and sine (m and m' of unlike parity vanish in phi), so Gauss-Legendre in c is
// exact.
TEST(HemisphericalHarmonics, AreOrthonormalOnTheHemisphere) {
  const auto basis = analyticBasis(BasisFamily::HemisphericalHarmonics, 81);
  std::vector<double> gram(81 * 81, 0.0);
  for (const auto& [d, weight] : capQuadrature(pi / 2, 12)) {
    const std::vector<double> values = valuesAt(*basis, d);
    for (int a = 0; a < 81; ++a) {
      for (int b = 0; b < 81; ++b) gram[a * 81 + b] += weight * values[a] * values[b];
    }
  }
  for (int a = 0; a < 81; ++a) {
    for (int b = 0; b < 81; ++b) {
      EXPECT_NEAR(gram[a * 81 + b], a == b ? 1 : 0, 1e-12) << a << ' ' << b;
    }
  }
}

TEST(HemisphericalHarmonics, AreSphericalOnesAtTheStretchedAngle) {
  const auto hsh = analyticBasis(BasisFamily::HemisphericalHarmonics, 64);
  const auto sh = analyticBasis(BasisFamily::SphericalHarmonics, 64, LightDomain::Sphere);
  for (const double c : {0.0, 0.01, 0.3, 0.5, 0.99, 1.0}) {
    for (const double phi : {-3.0, 0.2, 1.5}) {
      const std::vector<double> h = valuesAt(*hsh, Direction::fromAngles(std::acos(c), phi));
      const std::vector<double> y = valuesAt(*sh, Direction::fromAngles(std::acos(2 * c - 1), phi));
      for (int k = 0; k < 64; ++k) {
        // Near the horizon the square root makes much of the rounding of acos and cos.
        EXPECT_NEAR(h[k], std::numbers::sqrt2 * y[k], c < 0.001 ? 3e-7 : 2e-12)
            << c << ' ' << phi << ' ' << k;
      }
    }
  }
}

TEST(HemisphericalHarmonics, KnownValues) {
  const auto basis = analyticBasis(BasisFamily::HemisphericalHarmonics, 9);
  const Direction d = Direction::fromAngles(1.0, 0.6);
  const double c = std::cos(1.0), root = std::sqrt(c * (1 - c));
  const std::vector<double> values = valuesAt(*basis, d);
  EXPECT_NEAR(values[0], 1 / std::sqrt(2 * pi), 1e-15);
  EXPECT_NEAR(values[1], -std::sqrt(6 / pi) * std::sin(0.6) * root, 1e-15);
  EXPECT_NEAR(values[2], std::sqrt(3 / (2 * pi)) * (2 * c - 1), 1e-15);
  EXPECT_NEAR(values[3], -std::sqrt(6 / pi) * std::cos(0.6) * root, 1e-15);
  EXPECT_NEAR(values[6], std::sqrt(5 / (2 * pi)) * (6 * c * c - 6 * c + 1), 1e-15);
}

TEST(HemisphericalHarmonics, KeepTheEquatorsValuesBelowIt) {
  const auto basis = analyticBasis(BasisFamily::HemisphericalHarmonics, 16);
  const std::vector<double> equator = valuesAt(*basis, Direction::fromVector({1, 0, 0}));
  for (const Vector3 v : {Vector3{0.6, 0.8, 0}, Vector3{-1, 1, -1}, Vector3{0, 0, -1}}) {
    const std::vector<double> below = valuesAt(*basis, Direction::fromVector(v));
    for (int k = 0; k < 16; ++k) EXPECT_NEAR(below[k], equator[k], 1e-12) << v.z << ' ' << k;
  }
}

TEST(HemisphericalHarmonics, ContinueEvenlyPastTheEquatorOnTheChart) {
  const auto basis = analyticBasis(BasisFamily::HemisphericalHarmonics, 16);
  std::vector<double> at(16), past(16);
  for (const double r : {0.0, 0.5, 0.999}) {
    const ChartPoint p{0, 0.5 + 0.3 * r, 0.5 + 0.4 * r};
    basis->evaluateOnChart(p, at);
    const std::vector<double> direct = valuesAt(*basis, directionFromChart(p));
    for (int k = 0; k < 16; ++k) EXPECT_NEAR(at[k], direct[k], 1e-12) << r << ' ' << k;
  }
  // Y_1,1 is the square root alone: equal on both sides.
  const double inside = 0.99, outside = 1 / inside;
  basis->evaluateOnChart({0, 0.5 + 0.5 * inside, 0.5}, at);
  basis->evaluateOnChart({0, 0.5 + 0.5 * outside, 0.5}, past);
  EXPECT_NEAR(at[3], past[3], 0.02 * std::abs(at[3]));
}

}  // namespace
}  // namespace illum
