// Geometry in the object frame: right-handed, x right, y up, z toward the viewer
// (docs/conventions.md, "Frames").
#pragma once

#include <cmath>

namespace illum {

/// Any triple of coordinates: a displacement, or what a file said before it was checked.
struct Vector3 {
  double x = 0, y = 0, z = 0;

  friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector3 operator*(double s, Vector3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

inline double dot(Vector3 a, Vector3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vector3 cross(Vector3 a, Vector3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(Vector3 a) {
  // hypot divides three times to keep squares clear of overflow and of denormals: only where need
  // be.
  constexpr double kLeast = 1e-280, kGreatest = 1e280;
  const double squared = dot(a, a);
  return squared > kLeast && squared < kGreatest ? std::sqrt(squared) : std::hypot(a.x, a.y, a.z);
}

/// A unit vector from the object *to* the light. Its length is 1 within rounding, always.
class Direction {
 public:
  /// Toward the viewer.
  Direction() = default;

  /// Normalises. Throws Error (Fault::Input) for zero, infinite or NaN coordinates.
  static Direction fromVector(Vector3 v);

  /// theta: angle from +z in [0, pi]; phi: from +x toward +y; radians.
  static Direction fromAngles(double thetaRadians, double phiRadians);

  double x() const { return v_.x; }
  double y() const { return v_.y; }
  double z() const { return v_.z; }
  Vector3 vector() const { return v_; }
  double thetaRadians() const;  ///< in [0, pi]
  double phiRadians() const;    ///< in (-pi, pi]; 0 at the poles

  friend bool operator==(const Direction&, const Direction&) = default;

 private:
  Vector3 v_{0, 0, 1};
};

/// The angle between two directions in radians, accurate also for tiny angles.
double angleRadians(Direction a, Direction b);

}  // namespace illum
