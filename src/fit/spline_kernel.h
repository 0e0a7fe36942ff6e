// Reproducing kernels of the splines on the sphere.
#pragma once

#include <array>

namespace illum {

/// k_s(gamma) = sum_{l=1}^{30} (2l+1) / (l(l+1))^s P_l(cos gamma), scaled to k_s(0) = 1: the
/// covariance whose kriging minimises the integral of |Laplacian^(s/2) f|^2 (Wahba, "Spline
/// interpolation and smoothing on the sphere", 1981, where s = m). Larger orders are smoother; 1.5
/// behaves like an exponential covariance for nearby directions, 2 is the thin plate. Cut at degree
/// 30, that is 6 degrees: no light set and no light table resolves more.
class SplineKernel {
 public:
  /// order > 1.
  explicit SplineKernel(double order);
  /// At the angle whose cosine is given, in [-1, 1].
  double operator()(double cosine) const;

 private:
  static constexpr int kDegree = 30;
  std::array<double, kDegree + 1> coefficients_{};
};

}  // namespace illum
