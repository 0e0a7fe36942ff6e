// Rigid transforms between frames. Named aFromB, so that chains read as they cancel.
#pragma once

#include <array>

#include "illum/vector.h"

namespace illum {

/// p_a = rotation * p_b + translation. `rotation` is row-major, orthonormal, of determinant 1.
struct RigidTransform {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector3 translation;

  Vector3 point(Vector3 p) const { return vector(p) + translation; }
  /// Without the translation: displacements and directions.
  Vector3 vector(Vector3 v) const {
    const std::array<double, 9>& m = rotation;
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
  }
  Direction direction(Direction d) const;

  friend bool operator==(const RigidTransform&, const RigidTransform&) = default;
};

RigidTransform inverse(const RigidTransform& aFromB);
/// aFromB * bFromC is aFromC.
RigidTransform operator*(const RigidTransform& aFromB, const RigidTransform& bFromC);

/// The frame of a camera at `eye` whose -z points at `target` and whose y is as near to `up` as
/// can be: objectFromCamera. Throws Error (Fault::Input) where that determines no frame.
RigidTransform lookAt(Vector3 eye, Vector3 target, Vector3 up);

/// Right-handed rotation about `axis` through the origin.
RigidTransform rotationAbout(Direction axis, double radians);

}  // namespace illum
