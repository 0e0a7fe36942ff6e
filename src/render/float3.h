// Vectors in single precision: what rays are made of.
#pragma once

#include <algorithm>
#include <cmath>

#include "illum/vector.h"

namespace illum {

struct Float3 {
  float x = 0, y = 0, z = 0;

  friend Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Float3 operator-(Float3 a) { return {-a.x, -a.y, -a.z}; }
  friend Float3 operator*(float s, Float3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(const Float3&, const Float3&) = default;
};

inline Float3 float3(Vector3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vector3 vector3(Float3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline float dot(Float3 a, Float3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float3 cross(Float3 a, Float3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Float3 a) {
  return std::sqrt(dot(a, a));
}
/// Precondition: not zero.
inline Float3 normalised(Float3 a) {
  return (1 / length(a)) * a;
}

/// Two unit vectors that make a right-handed orthonormal frame with a unit vector, which is its z.
struct Frame {
  Float3 x, y, z;

  /// Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin: "Building an orthonormal basis,
  /// revisited", 2017.
  explicit Frame(Float3 unit) : z(unit) {
    const float sign = std::copysign(1.0f, z.z);
    const float a = -1 / (sign + z.z), b = z.x * z.y * a;
    x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }
  /// x as near as can be to `along`, which is not parallel to `unit`.
  Frame(Float3 unit, Float3 along) : z(unit) {
    x = normalised(along - dot(along, unit) * unit);
    y = cross(z, x);
  }

  Float3 local(Float3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Float3 world(Float3 v) const { return v.x * x + v.y * y + v.z * z; }
};

}  // namespace illum
