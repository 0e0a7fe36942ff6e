#include "fit/bases/light_basis_family.h"

#include <string>

#include "fit/bases/families.h"
#include "fit/bases/guard_ring.h"
#include "fit/bases/real_harmonics.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr int kMaxCosines = 256;

int degreeFrom(int coefficients, const char* family) {
  std::string allowed;
  for (int l = 0; l <= kMaxHarmonicDegree; ++l) {
    const int count = (l + 1) * (l + 1);
    if (coefficients == count) return l;
    allowed += (l == 0 ? "" : l == kMaxHarmonicDegree ? " or " : ", ") + std::to_string(count);
  }
  throw Error(Fault::Usage, std::string(family) + ": expected " + allowed +
                                " coefficients, found " + std::to_string(coefficients));
}

}  // namespace

void AnalyticBasis::evaluateOnChart(ChartPoint p, std::span<double> values) const {
  evaluate(directionFromChart(p), values);
}

std::unique_ptr<AnalyticBasis> analyticBasis(BasisFamily family, int coefficients,
                                             LightDomain domain) {
  switch (family) {
    case BasisFamily::SphericalHarmonics:
      return sphericalHarmonics(degreeFrom(coefficients, "spherical harmonics"), domain);
    case BasisFamily::HemisphericalHarmonics:
      if (domain == LightDomain::Sphere) {
        throw Error(Fault::Usage,
                    "hemispherical harmonics: expected lights on the upper hemisphere, found some "
                    "below it");
      }
      return hemisphericalHarmonics(degreeFrom(coefficients, "hemispherical harmonics"));
    case BasisFamily::Cosine:
      if (coefficients < 1 || coefficients > kMaxCosines) {
        throw Error(Fault::Usage, "cosines: expected 1 to " + std::to_string(kMaxCosines) +
                                      " coefficients, found " + std::to_string(coefficients));
      }
      return chartCosines(coefficients, domain);
    case BasisFamily::Learned:
    case BasisFamily::Exact:
      break;
  }
  throw Error(Fault::Usage, "expected a basis of closed form (sh, hsh, dct), found another");
}

BasisTable tableOf(const AnalyticBasis& basis, int resolution) {
  BasisTable table(basis.domain(), resolution, basis.coefficients());
  const auto values = [&](ChartPoint p, std::span<double> out) { basis.evaluateOnChart(p, out); };
  if (basis.smoothAcrossEquator()) {
    table.fillChart(values);
  } else {
    fillWithFittedGuard(table, values);
  }
  return table;
}

}  // namespace illum
