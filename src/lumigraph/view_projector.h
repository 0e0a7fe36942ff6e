// A view prepared for many points: where it sees them, how far away, how finely.
#pragma once

#include <cmath>
#include <limits>

#include "illum/camera.h"

namespace illum {

/// A position in a view's picture, and a range: what grows away from the eye whatever a view's
/// depth is (along the axis of slabs' views, pinhole cameras and photographs, all round for
/// panoramas).
struct Sighting {
  double x = 0, y = 0, range = 0;
};

inline constexpr double kNothing = std::numeric_limits<double>::infinity();

class ViewProjector {
 public:
  explicit ViewProjector(const ViewGeometry& view);

  Size size() const { return size_; }
  /// Whether the first column continues the last.
  bool wraps() const { return wraps_; }
  /// Whether 1 / range, and not the range, is linear over the picture of a plane.
  bool isPerspective() const { return kind_ == Kind::Perspective; }

  /// False for what no position shows. Positions outside the picture are true.
  bool see(Vector3 point, Sighting& seen) const {
    if (kind_ == Kind::Around) return seeAround(point, seen);
    const Vector3 p = cameraFromObject_.point(point);
    seen.range = -p.z;
    if (kind_ == Kind::Parallel) {
      seen.x = p.x / widthPerRange_ + 0.5 * size_.width;
      seen.y = 0.5 * size_.height - p.y / widthPerRange_;
      return true;
    }
    if (seen.range <= 0) return false;
    const double inverseRange = 1 / seen.range;
    seen.x = centre_.x + focalX_ * p.x * inverseRange;
    seen.y = centre_.y - focalY_ * p.y * inverseRange;
    return true;
  }
  /// The inverse.
  Vector3 pointAt(double x, double y, double range) const;
  /// `direction` is of any length.
  Ray ray(double x, double y) const;
  /// From the point to the eye, of unit length.
  Vector3 towardEye(Vector3 point) const {
    if (kind_ == Kind::Parallel) return {0, 0, 1};
    const Vector3 way = eye() - point;
    const double far = length(way);
    return far > 0 ? (1 / far) * way : -1.0 * axis();
  }
  /// Where all rays come from; of photographs, far in front.
  Vector3 eye() const { return objectFromCamera_.translation; }
  /// Where the middle of the picture looks, of unit length.
  Vector3 axis() const;

  /// kNothing for depths that are not finite.
  double rangeOf(double depth) const {
    return std::isfinite(depth) ? rangeOfZero_ + rangePerDepth_ * depth : kNothing;
  }
  double depthOf(double range) const { return (range - rangeOfZero_) / rangePerDepth_; }
  /// What a pixel covers of a surface that faces it.
  double pixelWidth(double range) const {
    return kind_ == Kind::Parallel ? widthPerRange_ : widthPerRange_ * range;
  }

 private:
  enum class Kind { Perspective, Parallel, Around };
  void setPinhole(const PinholeCamera& camera);
  bool seeAround(Vector3 point, Sighting& seen) const;

  Kind kind_ = Kind::Perspective;
  Size size_;
  bool wraps_ = false;
  RigidTransform objectFromCamera_, cameraFromObject_;
  double focalX_ = 1, focalY_ = 1;
  PixelPosition centre_;
  double rangeOfZero_ = 0, rangePerDepth_ = 1, widthPerRange_ = 1;
  ViewGeometry around_;  // of Kind::Around
};

}  // namespace illum
