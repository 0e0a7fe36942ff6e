// Hemispherical harmonics: P. Gautron, J. Krivanek, S. Pattanaik, K. Bouatouch, "A Novel
// Hemispherical Basis for Accurate and Efficient Rendering", Eurographics Symposium on Rendering
// 2004.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/bases/families.h"
#include "fit/bases/real_harmonics.h"

namespace illum {
namespace {

// H_lm(theta, phi) = sqrt(2) Y_lm with cos(theta) replaced by 2 cos(theta) - 1: the hemisphere's
// cosines [0, 1] are stretched over the sphere's [-1, 1]. d(cos) doubles, so the square root of 2
// keeps the functions orthonormal. The whole equator is one point to them, the sphere's south pole.
class HemisphericalHarmonics final : public AnalyticBasis {
 public:
  explicit HemisphericalHarmonics(int lMax) : lMax_(lMax) {}

  std::string_view name() const override { return "hsh"; }
  int coefficients() const override { return (lMax_ + 1) * (lMax_ + 1); }
  LightDomain domain() const override { return LightDomain::Hemisphere; }

  // Below the horizon: the equator's values, which the paper's extension keeps all the way down,
  // because they are the same all round.
  void evaluate(Direction d, std::span<double> values) const override {
    evaluateAt(d, std::max(0.0, d.z()), values);
  }

  // Functions of odd m rise from the equator like the square root of the height above it. Continued
  // as even functions, with |cos(theta)| under the root, they have a cusp there.
  void evaluateOnChart(ChartPoint p, std::span<double> values) const override {
    const Direction d = directionFromChart(p);
    evaluateAt(d, d.z(), values);
  }

  bool smoothAcrossEquator() const override { return false; }

 private:
  // At the azimuth of d and cos(theta) = c.
  void evaluateAt(Direction d, double c, std::span<double> values) const {
    const double horizontal = std::hypot(d.x(), d.y());
    // sin of the stretched angle: sqrt(1 - (2c-1)^2) = 2 sqrt(c (1-c)).
    const double sine = 2 * std::sqrt(std::abs(c) * std::max(0.0, 1 - c));
    const double scale = horizontal > 0 ? sine / horizontal : 0;
    realHarmonics(scale * d.x(), scale * d.y(), 2 * c - 1, lMax_, values);
    for (double& value : values) value *= std::numbers::sqrt2;
  }

  int lMax_;
};

}  // namespace

std::unique_ptr<AnalyticBasis> hemisphericalHarmonics(int lMax) {
  return std::make_unique<HemisphericalHarmonics>(lMax);
}

}  // namespace illum
