#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fit/bases/light_basis_family.h"
#include "fit/bases/real_harmonics.h"
#include "fit/quadrature.h"
#include "illum/error.h"

namespace illum {
namespace {

using std::numbers::pi;

std::vector<double> valuesAt(const AnalyticBasis& basis, Direction d) {
  std::vector<double> values(basis.coefficients());
  basis.evaluate(d, values);
  return values;
}

std::unique_ptr<AnalyticBasis> harmonics(int lMax) {
  return analyticBasis(BasisFamily::SphericalHarmonics, (lMax + 1) * (lMax + 1),
                       LightDomain::Sphere);
}

std::vector<Direction> someDirections(int count) {
  std::mt19937 random(8);
  std::normal_distribution<double> coordinate;
  std::vector<Direction> directions = {Direction::fromVector({0, 0, 1}),
                                       Direction::fromVector({0, 0, -1}),
                                       Direction::fromVector({1, 0, 0})};
  while (static_cast<int>(directions.size()) < count) {
    directions.push_back(
        Direction::fromVector({coordinate(random), coordinate(random), coordinate(random)}));
  }
  return directions;
}

double factorial(int n) {
  return std::tgamma(n + 1.0);
}

// The paper's section 4.1 read aloud: angles, its recurrence with its three cases, its N_lm.
double paperLegendre(int l, int m, double x) {
  if (l == 0 && m == 0) return 1;
  if (l == m) return (1 - 2 * m) * std::sqrt(1 - x * x) * paperLegendre(m - 1, m - 1, x);
  if (l == m + 1) return x * (2 * m + 1) * paperLegendre(m, m, x);
  return x * (2 * l - 1) / (l - m) * paperLegendre(l - 1, m, x) -
         static_cast<double>(l + m - 1) / (l - m) * paperLegendre(l - 2, m, x);
}

double paperHarmonic(int l, int m, double theta, double phi) {
  const int order = std::abs(m);
  const double n = std::sqrt((2 * l + 1) / (2 * pi) * factorial(l - order) / factorial(l + order));
  const double p = paperLegendre(l, order, std::cos(theta));
  if (m > 0) return n * p * std::cos(m * phi);
  if (m < 0) return n * p * std::sin(order * phi);
  return n * p / std::sqrt(2.0);
}

TEST(SphericalHarmonics, AreThePapersFormulas) {
  const auto basis = harmonics(8);
  for (const Direction& d : someDirections(60)) {
    const std::vector<double> values = valuesAt(*basis, d);
    for (int l = 0; l <= 8; ++l) {
      for (int m = -l; m <= l; ++m) {
        EXPECT_NEAR(values[l * (l + 1) + m], paperHarmonic(l, m, d.thetaRadians(), d.phiRadians()),
                    2e-13)
            << "l " << l << " m " << m << " theta " << d.thetaRadians() << " phi "
            << d.phiRadians();
      }
    }
  }
}

TEST(SphericalHarmonics, KnownValues) {
  const auto basis = harmonics(2);
  for (const Direction& d : someDirections(20)) {
    const double x = d.x(), y = d.y(), z = d.z();
    const std::vector<double> values = valuesAt(*basis, d);
    const double expected[] = {std::sqrt(1 / (4 * pi)),
                               -std::sqrt(3 / (4 * pi)) * y,
                               std::sqrt(3 / (4 * pi)) * z,
                               -std::sqrt(3 / (4 * pi)) * x,
                               std::sqrt(15 / (4 * pi)) * x * y,
                               -std::sqrt(15 / (4 * pi)) * y * z,
                               std::sqrt(5 / (16 * pi)) * (3 * z * z - 1),
                               -std::sqrt(15 / (4 * pi)) * x * z,
                               std::sqrt(15 / (16 * pi)) * (x * x - y * y)};
    for (int k = 0; k < 9; ++k) {
      EXPECT_NEAR(values[k], expected[k], 1e-15) << k << " at " << x << ' ' << y << ' ' << z;
    }
  }
}

TEST(SphericalHarmonics, AreOrthonormalOnTheSphere) {
  const auto basis = harmonics(8);
  std::vector<double> gram(81 * 81, 0.0);
  for (const auto& [d, weight] : capQuadrature(pi, 10)) {
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

TEST(SphericalHarmonics, HaveTheirDegreesParity) {
  const auto basis = harmonics(8);
  for (const Direction& d : someDirections(30)) {
    const std::vector<double> here = valuesAt(*basis, d);
    const std::vector<double> there = valuesAt(*basis, Direction::fromVector(-1.0 * d.vector()));
    for (int l = 0; l <= 8; ++l) {
      for (int k = l * l; k < (l + 1) * (l + 1); ++k) {
        EXPECT_NEAR(there[k], l % 2 == 0 ? here[k] : -here[k], 1e-14) << l << ' ' << k;
      }
    }
  }
}

// sum_m Y_lm(a) Y_lm(b) = (2l+1)/(4 pi) P_l(cos of the angle between them).
TEST(SphericalHarmonics, ObeyTheAdditionTheorem) {
  const auto basis = harmonics(8);
  const std::vector<Direction> directions = someDirections(20);
  for (const Direction& a : directions) {
    for (const Direction& b : directions) {
      const std::vector<double> va = valuesAt(*basis, a), vb = valuesAt(*basis, b);
      for (int l = 0; l <= 8; ++l) {
        double sum = 0;
        for (int k = l * l; k < (l + 1) * (l + 1); ++k) sum += va[k] * vb[k];
        const double cosine = std::clamp(dot(a.vector(), b.vector()), -1.0, 1.0);
        EXPECT_NEAR(sum, (2 * l + 1) / (4 * pi) * std::legendre(l, cosine), 1e-13) << l;
      }
    }
  }
}

TEST(SphericalHarmonics, LowerDegreesAreAPrefix) {
  const std::vector<double> all = valuesAt(*harmonics(8), Direction::fromVector({1, 2, -3}));
  for (int lMax = 0; lMax < 8; ++lMax) {
    const std::vector<double> few = valuesAt(*harmonics(lMax), Direction::fromVector({1, 2, -3}));
    ASSERT_EQ(few.size(), static_cast<std::size_t>((lMax + 1) * (lMax + 1)));
    for (std::size_t k = 0; k < few.size(); ++k) EXPECT_EQ(few[k], all[k]) << lMax << ' ' << k;
  }
}

}  // namespace
}  // namespace illum
