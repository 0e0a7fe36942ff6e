#include "fit/bases/light_basis_family.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "illum/error.h"

namespace illum {
namespace {

using std::numbers::pi;

std::string sentenceOf(BasisFamily family, int coefficients,
                       LightDomain domain = LightDomain::Hemisphere) {
  try {
    analyticBasis(family, coefficients, domain);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    return error.what();
  }
  return "";
}

TEST(LightBasisFamily, NamesWhatIsAllowed) {
  EXPECT_EQ(sentenceOf(BasisFamily::SphericalHarmonics, 20),
            "spherical harmonics: expected 1, 4, 9, 16, 25, 36, 49, 64 or 81 coefficients, found "
            "20");
  EXPECT_EQ(sentenceOf(BasisFamily::HemisphericalHarmonics, 0),
            "hemispherical harmonics: expected 1, 4, 9, 16, 25, 36, 49, 64 or 81 coefficients, "
            "found 0");
  EXPECT_EQ(sentenceOf(BasisFamily::Cosine, 257),
            "cosines: expected 1 to 256 coefficients, found 257");
  EXPECT_EQ(sentenceOf(BasisFamily::Cosine, -1),
            "cosines: expected 1 to 256 coefficients, found -1");
  EXPECT_NE(sentenceOf(BasisFamily::HemisphericalHarmonics, 9, LightDomain::Sphere), "");
  EXPECT_NE(sentenceOf(BasisFamily::Learned, 9), "");
}

TEST(LightBasisFamily, MakesWhatIsAskedFor) {
  for (const int count : {1, 4, 9, 16, 25, 36, 49, 64, 81}) {
    const auto sh = analyticBasis(BasisFamily::SphericalHarmonics, count, LightDomain::Sphere);
    EXPECT_EQ(sh->name(), "sh");
    EXPECT_EQ(sh->coefficients(), count);
    EXPECT_EQ(sh->domain(), LightDomain::Sphere);
    const auto hsh = analyticBasis(BasisFamily::HemisphericalHarmonics, count);
    EXPECT_EQ(hsh->name(), "hsh");
    EXPECT_EQ(hsh->coefficients(), count);
  }
  const auto dct = analyticBasis(BasisFamily::Cosine, 10, LightDomain::Sphere);
  EXPECT_EQ(dct->name(), "dct");
  EXPECT_EQ(dct->coefficients(), 10);
}

// Relative rms error over the basis's whole domain, all functions together, in decibels.
double tableErrorDecibels(const AnalyticBasis& basis, const BasisTable& table) {
  const int count = 6000;
  const double lowest = basis.domain() == LightDomain::Sphere ? -1 : 0;
  std::vector<double> exact(basis.coefficients());
  std::vector<float> sampled(basis.coefficients());
  double error = 0, power = 0;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (1 - lowest) * (i + 0.5) / count;
    const Direction d = Direction::fromAngles(std::acos(z), i * pi * (3 - std::sqrt(5.0)));
    basis.evaluate(d, exact);
    table.evaluate(d, sampled);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      error += (sampled[k] - exact[k]) * (sampled[k] - exact[k]);
      power += exact[k] * exact[k];
    }
  }
  return 10 * std::log10(error / power);
}

struct Accuracy {
  BasisFamily family;
  int coefficients;
  LightDomain domain;
  double decibels33, decibels65;  ///< of the unrounded tables
};

// Held from both sides, within 0.7 dB.
TEST(LightBasisFamily, TablesAreAsAccurateAsMeasured) {
  const auto above = LightDomain::Hemisphere, round = LightDomain::Sphere;
  const Accuracy cases[] = {{BasisFamily::SphericalHarmonics, 16, above, -70.1, -88.9},
                            {BasisFamily::SphericalHarmonics, 25, above, -63.6, -82.7},
                            {BasisFamily::SphericalHarmonics, 64, above, -49.6, -69.6},
                            {BasisFamily::SphericalHarmonics, 25, round, -63.6, -82.7},
                            {BasisFamily::SphericalHarmonics, 64, round, -49.6, -69.6},
                            {BasisFamily::HemisphericalHarmonics, 9, above, -47.1, -53.3},
                            {BasisFamily::HemisphericalHarmonics, 16, above, -43.8, -50.3},
                            {BasisFamily::Cosine, 16, above, -64.9, -83.9},
                            {BasisFamily::Cosine, 64, above, -46.4, -66.5},
                            {BasisFamily::Cosine, 128, round, -46.4, -66.5}};
  for (const Accuracy& c : cases) {
    const auto basis = analyticBasis(c.family, c.coefficients, c.domain);
    const std::string what = std::string(basis->name()) + " " + std::to_string(c.coefficients);
    EXPECT_NEAR(tableErrorDecibels(*basis, tableOf(*basis, 33)), c.decibels33, 0.7) << what;
    EXPECT_NEAR(tableErrorDecibels(*basis, tableOf(*basis, 65)), c.decibels65, 0.7) << what;
  }
}

struct Size {
  BasisFamily family;
  int coefficients;
  std::size_t bytes;
};

// Two-sided as well: bytes of basis.bin at 33^2 and the default error, within 8 percent; and that
// error does not spoil the table's own.
TEST(LightBasisFamily, TablesTakeTheBytesMeasured) {
  const Size cases[] = {{BasisFamily::SphericalHarmonics, 16, 6650},
                        {BasisFamily::SphericalHarmonics, 25, 12400},
                        {BasisFamily::HemisphericalHarmonics, 16, 12500},
                        {BasisFamily::Cosine, 16, 4000}};
  for (const Size& c : cases) {
    const auto basis = analyticBasis(c.family, c.coefficients);
    BasisTable table = tableOf(*basis, 33);
    const double before = tableErrorDecibels(*basis, table);
    const double bytes = static_cast<double>(table.encode().size());
    const std::string what = std::string(basis->name()) + " " + std::to_string(c.coefficients);
    EXPECT_NEAR(bytes, static_cast<double>(c.bytes), 0.08 * static_cast<double>(c.bytes)) << what;
    const double after = tableErrorDecibels(*basis, table);
    EXPECT_LT(after, std::max(before + 2.2, -70.0)) << what;
  }
}

TEST(LightBasisFamily, CosinesAgreeWithTheirTableBelowTheHorizon) {
  const auto basis = analyticBasis(BasisFamily::Cosine, 9);
  const BasisTable table = tableOf(*basis, 65);
  std::vector<double> exact(9);
  std::vector<float> sampled(9);
  for (const double theta : {1.6, 2.2, 2.9, pi}) {
    for (const double phi : {-2.0, 0.3, 1.8}) {
      basis->evaluate(Direction::fromAngles(theta, phi), exact);
      table.evaluate(Direction::fromAngles(theta, phi), sampled);
      for (int k = 0; k < 9; ++k) {
        EXPECT_NEAR(sampled[k], exact[k], 1e-4) << theta << ' ' << phi << ' ' << k;
      }
    }
  }
}

// HSH tables with a fitted guard ring against the ones that only continue the functions: the square
// root at the equator is met more than ten decibels better.
TEST(LightBasisFamily, AFittedGuardRingMeetsTheEquatorBetter) {
  const auto basis = analyticBasis(BasisFamily::HemisphericalHarmonics, 16);
  BasisTable continued(LightDomain::Hemisphere, 33, 16);
  continued.fillChart(
      [&](ChartPoint p, std::span<double> values) { basis->evaluateOnChart(p, values); });
  const BasisTable fitted = tableOf(*basis, 33);
  EXPECT_LT(tableErrorDecibels(*basis, fitted), tableErrorDecibels(*basis, continued) - 10);
  // Samples within the disc stay the functions' own.
  const std::size_t centre = 17 * 35 + 17;
  for (int c = 0; c < 16; ++c) {
    EXPECT_EQ(fitted.values()[c * 35 * 35 + centre], continued.values()[c * 35 * 35 + centre]) << c;
  }
}

// A function that is 1 everywhere stays 1 below the horizon, too.
TEST(LightBasisFamily, TheFirstFunctionIsConstantEverywhere) {
  const struct {
    BasisFamily family;
    double value;
  } cases[] = {{BasisFamily::SphericalHarmonics, 1 / std::sqrt(4 * pi)},
               {BasisFamily::HemisphericalHarmonics, 1 / std::sqrt(2 * pi)},
               {BasisFamily::Cosine, 1}};
  for (const auto& [family, value] : cases) {
    const BasisTable table = tableOf(*analyticBasis(family, 4), 17);
    std::vector<float> at(4);
    for (const double theta : {0.0, 0.4, 1.5, pi / 2, 1.7, 2.5, pi}) {
      table.evaluate(Direction::fromAngles(theta, 1), at);
      EXPECT_NEAR(at[0], value, 1e-6) << theta;
    }
  }
}

}  // namespace
}  // namespace illum
