// Interpolation between scattered lights: universal kriging on the sphere.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fit/dense.h"
#include "fit/spline_kernel.h"
#include "illum/basis_table.h"

namespace illum {

/// s(w) = trend(w) + residual(w): the trend in spherical harmonics up to `trendOrder`, the residual
/// with covariance k_order, and independent noise of variance `nugget` (in units of k(0) = 1) in
/// the samples.
struct KrigingModel {
  double splineOrder = 2;
  int trendOrder = 0;
  double nugget = 1e-2;
};

/// The best linear unbiased predictor of that model (Matheron 1969; Cressie 1993, section 3.4.5).
/// With splineOrder = 2 it is the smoothing spline of Wahba 1981 with lambda proportional to the
/// nugget. Constants are reproduced exactly. Immutable, thread safe.
class Kriging {
 public:
  /// At least (trendOrder + 1)^2 lights, in general position; see trendIsSupported.
  Kriging(std::span<const Direction> lights, KrigingModel model);

  int lights() const { return static_cast<int>(lights_.size()); }
  const KrigingModel& model() const { return model_; }

  /// weights[i] of light i's sample in the prediction at `d`; `weights` has lights() entries,
  /// sum 1.
  void weights(Direction d, std::span<double> weights) const;
  /// One row a direction.
  Matrix weightsAt(std::span<const Direction> directions) const;

 private:
  std::vector<Direction> lights_;
  KrigingModel model_;
  SplineKernel kernel_;
  Matrix kernelWeights_;  // lights x lights: Q = A^-1 - A^-1 F (F^T A^-1 F)^-1 F^T A^-1
  Matrix trendWeights_;   // lights x trend functions: A^-1 F (F^T A^-1 F)^-1
};

/// Whether the lights tell all trend functions up to `order` apart.
bool trendIsSupported(std::span<const Direction> lights, int order);

/// Mean square errors at left-out lights of all `nuggets` at once: one column each. With Q as above
/// the error at light i is (Q s)_i / Q_ii (Dubrule, "Cross validation of kriging in a unique
/// neighborhood", 1983, eq. 15); all nuggets share one eigendecomposition. `gram`: lights x lights,
/// mean over channels.
Matrix krigingLeaveOneOut(std::span<const Direction> lights, double splineOrder, int trendOrder,
                          std::span<const double> nuggets, const Matrix& gram);

struct KrigingChoice {
  KrigingModel model;
  Vector errors;  ///< at left-out lights
};

/// The best model by meanDecibels at left-out lights, among those that stay sane wherever a light
/// may be put in `domain` (docs/math/fitting.md, "Staying sane between and beyond the lights").
/// `nugget`: fixed if set. At least one light.
KrigingChoice chooseKriging(std::span<const Direction> lights, const Matrix& gram,
                            LightDomain domain, std::optional<double> nugget);

}  // namespace illum
