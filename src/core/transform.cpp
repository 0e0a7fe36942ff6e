#include "illum/transform.h"

#include <cmath>

#include "illum/error.h"

namespace illum {
namespace {

std::array<double, 9> transposed(const std::array<double, 9>& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

}  // namespace

Direction RigidTransform::direction(Direction d) const {
  return Direction::fromVector(vector(d.vector()));
}

RigidTransform inverse(const RigidTransform& aFromB) {
  RigidTransform bFromA;
  bFromA.rotation = transposed(aFromB.rotation);
  bFromA.translation = -1.0 * bFromA.vector(aFromB.translation);
  return bFromA;
}

RigidTransform operator*(const RigidTransform& aFromB, const RigidTransform& bFromC) {
  RigidTransform aFromC;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += aFromB.rotation[3 * row + k] * bFromC.rotation[3 * k + column];
      }
      aFromC.rotation[3 * row + column] = sum;
    }
  }
  aFromC.translation = aFromB.point(bFromC.translation);
  return aFromC;
}

RigidTransform lookAt(Vector3 eye, Vector3 target, Vector3 up) {
  const Vector3 back = eye - target;
  const Vector3 right = cross(up, back);
  // Normalising refuses an eye in its target and an `up` along the line of sight.
  if (!(length(back) > 0) || !(length(right) > 1e-9 * length(up) * length(back))) {
    throw Error(Fault::Input,
                "camera: expected an eye away from its target and an up across the line of sight, "
                "found none");
  }
  const Vector3 z = Direction::fromVector(back).vector();
  const Vector3 x = Direction::fromVector(right).vector();
  const Vector3 y = cross(z, x);
  return {{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}, eye};
}

RigidTransform rotationAbout(Direction axis, double radians) {
  // Rodrigues' formula.
  const double c = std::cos(radians), s = std::sin(radians), t = 1 - c;
  const double x = axis.x(), y = axis.y(), z = axis.z();
  return {{t * x * x + c, t * x * y - s * z, t * x * z + s * y, t * x * y + s * z, t * y * y + c,
           t * y * z - s * x, t * x * z - s * y, t * y * z + s * x, t * z * z + c},
          {}};
}

}  // namespace illum
