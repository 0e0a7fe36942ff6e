// Geometry in the object frame: right-handed, x right, y up, z toward the viewer
// (docs/conventions.md, "Frames").
#pragma once

namespace illum {

/// Any triple of coordinates: a displacement, or what a file said before it was checked.
struct Vector3 {
  double x = 0, y = 0, z = 0;

  friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector3 operator*(double s, Vector3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

double dot(Vector3 a, Vector3 b);
Vector3 cross(Vector3 a, Vector3 b);
double length(Vector3 a);

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
