#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "fit/bases/families.h"
#include "fit/bases/real_harmonics.h"

namespace illum {
namespace {

// N_lm of the paper: sqrt((2l+1)/(2 pi) * (l-m)!/(l+m)!), m >= 0; with its 1/sqrt(2) for m = 0.
double normalisation(int l, int m) {
  double ratio = 1;
  for (int k = l - m + 1; k <= l + m; ++k) ratio /= k;
  const double n = std::sqrt((2 * l + 1) / (2 * std::numbers::pi) * ratio);
  return m == 0 ? n / std::numbers::sqrt2 : n;
}

using NormalisationTable =
    std::array<std::array<double, kMaxHarmonicDegree + 1>, kMaxHarmonicDegree + 1>;

const NormalisationTable& normalisations() {
  static const NormalisationTable table = [] {
    NormalisationTable t{};
    for (int l = 0; l <= kMaxHarmonicDegree; ++l) {
      for (int m = 0; m <= l; ++m) t[l][m] = normalisation(l, m);
    }
    return t;
  }();
  return table;
}

class SphericalHarmonics final : public AnalyticBasis {
 public:
  SphericalHarmonics(int lMax, LightDomain domain) : lMax_(lMax), domain_(domain) {}

  std::string_view name() const override { return "sh"; }
  int coefficients() const override { return (lMax_ + 1) * (lMax_ + 1); }
  LightDomain domain() const override { return domain_; }
  void evaluate(Direction d, std::span<double> values) const override {
    realHarmonics(d.x(), d.y(), d.z(), lMax_, values);
  }

 private:
  int lMax_;
  LightDomain domain_;
};

}  // namespace

// The paper's recurrence for P_lm carries the factor sin(theta)^m from its first line, P_mm. Left
// out there and joined to the azimuth instead, sin(theta)^m (cos(m phi), sin(m phi)) is the power
// (x + iy)^m: no angle is computed and the poles are like any other place.
void realHarmonics(double x, double y, double z, int lMax, std::span<double> values) {
  assert(lMax >= 0 && lMax <= kMaxHarmonicDegree);
  assert(values.size() == static_cast<std::size_t>((lMax + 1) * (lMax + 1)));
  const NormalisationTable& n = normalisations();
  double pmm = 1, real = 1, imaginary = 0;
  for (int m = 0; m <= lMax; ++m) {
    if (m > 0) {
      pmm *= 1 - 2 * m;
      const double previous = real;
      real = x * previous - y * imaginary;
      imaginary = x * imaginary + y * previous;
    }
    double below = 0, p = pmm;  // P_{l-1,m} and P_lm
    for (int l = m; l <= lMax; ++l) {
      if (l > m) {
        // For l = m + 1 this is the paper's second line, since P_{m-1,m} = 0.
        const double next = (z * (2 * l - 1) * p - (l + m - 1) * below) / (l - m);
        below = p;
        p = next;
      }
      const double scaled = n[l][m] * p;
      values[l * (l + 1) + m] = scaled * real;
      if (m > 0) values[l * (l + 1) - m] = scaled * imaginary;
    }
  }
}

std::unique_ptr<AnalyticBasis> sphericalHarmonics(int lMax, LightDomain domain) {
  return std::make_unique<SphericalHarmonics>(lMax, domain);
}

}  // namespace illum
