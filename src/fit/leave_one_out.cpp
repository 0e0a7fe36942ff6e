#include "fit/leave_one_out.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace illum {
namespace {

// Below this an error is rounding: 120 dB.
constexpr double kLeastError = 1e-12;

}  // namespace

double meanDecibels(const Vector& meanSquareErrors) {
  if (meanSquareErrors.size() == 0) return 0;
  double sum = 0;
  for (const double e : meanSquareErrors) sum -= 10 * std::log10(std::max(e, kLeastError));
  return sum / static_cast<double>(meanSquareErrors.size());
}

Vector usedErrors(const Matrix& smoother, const Matrix& gram) {
  const Matrix residual = Matrix::Identity(smoother.rows(), smoother.cols()) - smoother;
  const Matrix product = residual * gram;
  return product.cwiseProduct(residual).rowwise().sum().cwiseMax(0.0);
}

Vector leaveOneOutErrors(const Matrix& smoother, const Matrix& gram) {
  Vector errors = usedErrors(smoother, gram);
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    const double own = 1 - smoother(i, i);
    errors[i] =
        std::abs(own) > 1e-9 ? errors[i] / (own * own) : std::numeric_limits<double>::infinity();
  }
  return errors;
}

}  // namespace illum
