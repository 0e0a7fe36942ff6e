#include "fit/fit.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fit/dense.h"
#include "fit/exact_basis.h"
#include "fit/learned_basis.h"
#include "fit/separable_fit.h"
#include "illum/error.h"

namespace illum {
namespace {

void requireSense(std::size_t lights, const SampleStatistics& statistics,
                  const FitOptions& options) {
  if (lights == 0) throw Error(Fault::Input, "fitting: expected at least one light, found none");
  if (statistics.lights != static_cast<int>(lights)) {
    throw Error(Fault::Input, fmt::format("fitting: expected samples of {} lights, found {}",
                                          lights, statistics.lights));
  }
  for (const double moment : statistics.gram) {
    if (!std::isfinite(moment)) {
      throw Error(Fault::Input, "fitting: expected finite samples, found infinite ones or NaN");
    }
  }
  if (options.regularizer && !(*options.regularizer >= 0 && std::isfinite(*options.regularizer))) {
    throw Error(Fault::Usage, fmt::format("regularizer: expected a number of at least 0, found {}",
                                          *options.regularizer));
  }
  if (options.coefficients < 0 || options.planes < 0) {
    throw Error(Fault::Usage, "coefficients and planes: expected numbers of at least 0");
  }
}

}  // namespace

Fit fitBasis(const std::vector<DirectionalLight>& lights, const SampleStatistics& statistics,
             const FitOptions& options) {
  requireSense(lights.size(), statistics, options);
  useOneBlasThread();
  std::vector<Direction> directions;
  for (const DirectionalLight& light : lights) directions.push_back(light.toLight);
  if (options.family == BasisFamily::Exact) return fitExact(directions, statistics, options);
  Fit fit = options.family == BasisFamily::Learned ? fitLearned(directions, statistics, options)
                                                   : fitSeparable(directions, statistics, options);
  if (lights.size() == 1) fit.leaveOneOutDecibels = std::numeric_limits<double>::quiet_NaN();
  return fit;
}

}  // namespace illum
