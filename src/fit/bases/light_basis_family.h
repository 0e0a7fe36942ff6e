// Light bases with a closed form. Every one that exists is listed in light_basis_family.cpp.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "fit/fit.h"
#include "illum/basis_table.h"
#include "illum/vector.h"

namespace illum {

/// Scalar functions of a light's direction, the same for every colour channel. Immutable, thread
/// safe.
class AnalyticBasis {
 public:
  virtual ~AnalyticBasis() = default;

  virtual std::string_view name() const = 0;  ///< "sh", "hsh", "dct"
  virtual int coefficients() const = 0;
  virtual LightDomain domain() const = 0;

  /// values[k] = k-th function at `d`; `values` has coefficients() entries. SH are defined all
  /// round; HSH and cosines on the hemisphere follow the paper's extension below it, as their
  /// tables do.
  virtual void evaluate(Direction d, std::span<double> values) const = 0;

  /// The same on the chart, continued smoothly past the equator of the point's own square: what a
  /// table needs for its guard ring.
  virtual void evaluateOnChart(ChartPoint p, std::span<double> values) const;

  /// Whether that continuation is smooth; if not, tables fit their guard ring (guard_ring.h).
  virtual bool smoothAcrossEquator() const { return true; }
};

/// Functions in the order that `coefficients` counts them. SH and HSH: (l, m) for l = 0, 1, … and
/// m = -l … l, so `coefficients` must be (l_max + 1)^2 <= 81. DCT: any number up to 256; on the
/// sphere the first half (rounded up) belongs to the upper square and the rest to the lower. Throws
/// Error (Fault::Usage) naming the allowed numbers, and for HSH on the sphere and
/// BasisFamily::Learned.
std::unique_ptr<AnalyticBasis> analyticBasis(BasisFamily family, int coefficients,
                                             LightDomain domain = LightDomain::Hemisphere);

/// The basis sampled on the chart: resolution N as in BasisTable. Not yet rounded by encode().
BasisTable tableOf(const AnalyticBasis& basis, int resolution);

}  // namespace illum
