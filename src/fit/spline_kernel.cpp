#include "fit/spline_kernel.h"

#include <cassert>
#include <cmath>

namespace illum {
namespace {

// Clenshaw's recurrence with (l+1) P_{l+1} = (2l+1) x P_l - l P_{l-1}: the sum of a_l P_l takes
// b_l = a_l + rise_l x b_{l+1} - fall_l b_{l+2}. Divided once and for all, for divisions took most
// of the time.
template <std::size_t kCount>
struct Recurrence {
  std::array<double, kCount> rise{}, fall{};
  constexpr Recurrence() {
    for (std::size_t l = 0; l < kCount; ++l) {
      rise[l] = (2.0 * static_cast<double>(l) + 1) / (static_cast<double>(l) + 1);
      fall[l] = (static_cast<double>(l) + 1) / (static_cast<double>(l) + 2);
    }
  }
};

}  // namespace

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
  static constexpr Recurrence<kDegree + 1> kRecurrence;
  double next = 0, afterNext = 0;
  for (std::size_t l = kDegree; l >= 1; --l) {
    const double current =
        (coefficients_[l] - kRecurrence.fall[l] * afterNext) + kRecurrence.rise[l] * cosine * next;
    afterNext = next;
    next = current;
  }
  return coefficients_[0] + cosine * next - 0.5 * afterNext;
}

}  // namespace illum
