#include "fit/spline_kernel.h"

#include <cassert>
#include <cmath>

namespace illum {

SplineKernel::SplineKernel(double order) {
  assert(order > 1);
  double sum = 0;
  for (int l = 1; l <= kDegree; ++l) {
    coefficients_[l] = (2 * l + 1) / std::pow(l * (l + 1.0), order);
    sum += coefficients_[l];
  }
  for (double& c : coefficients_) c /= sum;
}

double SplineKernel::operator()(double cosine) const {
  // Clenshaw's recurrence with (l+1) P_{l+1} = (2l+1) x P_l - l P_{l-1}.
  double next = 0, afterNext = 0;
  for (int l = kDegree; l >= 1; --l) {
    const double current = coefficients_[l] + (2 * l + 1.0) / (l + 1.0) * cosine * next -
                           (l + 1.0) / (l + 2.0) * afterNext;
    afterNext = next;
    next = current;
  }
  return coefficients_[0] + cosine * next - 0.5 * afterNext;
}

}  // namespace illum
