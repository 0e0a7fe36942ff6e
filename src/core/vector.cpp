#include "illum/vector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "illum/error.h"

namespace illum {

Direction Direction::fromVector(Vector3 v) {
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
    throw Error(
        Fault::Input,
        fmt::format("expected a direction of finite coordinates, found {} {} {}", v.x, v.y, v.z));
  // A unit vector is left as it is, so that directions survive being written and read to the last
  // bit.
  constexpr double kUnitWithinRounding = 4 * std::numeric_limits<double>::epsilon();
  Direction direction;
  direction.v_ = v;
  if (std::abs(dot(v, v) - 1) <= kUnitWithinRounding) return direction;
  // Dividing by the largest coordinate first keeps squares clear of overflow and of denormals.
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0) throw Error(Fault::Input, "expected a direction, found the zero vector");
  const Vector3 scaled{v.x / largest, v.y / largest, v.z / largest};
  const double norm = length(scaled);
  direction.v_ = {scaled.x / norm, scaled.y / norm, scaled.z / norm};
  return direction;
}

Direction Direction::fromAngles(double thetaRadians, double phiRadians) {
  const double sinTheta = std::sin(thetaRadians);
  return fromVector(
      {sinTheta * std::cos(phiRadians), sinTheta * std::sin(phiRadians), std::cos(thetaRadians)});
}

double Direction::thetaRadians() const {
  return std::atan2(std::hypot(v_.x, v_.y), v_.z);
}

double Direction::phiRadians() const {
  if (v_.x == 0 && v_.y == 0) return 0;
  // Adding zero turns -0 into +0, so that the result is never -pi.
  return std::atan2(v_.y + 0.0, v_.x);
}

// W. Kahan, "How Futile are Mindless Assessments of Roundoff in Floating-Point Computation?", 2006,
// section 12: acos(a . b) loses half the digits near 0 and pi; this form loses none.
double angleRadians(Direction a, Direction b) {
  return 2 * std::atan2(length(a.vector() - b.vector()), length(a.vector() + b.vector()));
}

}  // namespace illum
