#include "render/camera_rays.h"

namespace illum {

PixelFilter::PixelFilter(double radius) {
  const double wide = std::max(std::min(1.0, 2 * radius), radius);
  const double narrow = 2 * radius - wide;
  flat_ = 0.5 * (wide - narrow);
  slope_ = narrow;
}

double PixelFilter::offset(double uniform) const {
  // By symmetry about the middle: `share` of the half on that side.
  const double side = uniform < 0.5 ? -1 : 1;
  const double share = uniform < 0.5 ? 1 - 2 * uniform : 2 * uniform - 1;
  // Areas under a top of height 1: flat_ and slope_ / 2.
  const double area = share * (flat_ + 0.5 * slope_);
  if (area <= flat_) return side * area;
  return side * (flat_ + slope_ * (1 - std::sqrt(std::max(0.0, 1 - 2 * (area - flat_) / slope_))));
}

CameraRays::CameraRays(const ViewGeometry& view, const Bounds& scene, double filterRadius,
                       int samplesPerPixel)
    : view_(view),
      centre_(0.5 * (scene.low + scene.high)),
      radius_(0.5 * length(scene.high - scene.low)),
      filter_(filterRadius),
      footprint_(1 / std::sqrt(static_cast<double>(samplesPerPixel))) {}

BeamRay CameraRays::through(int x, int y, const SampleSequence& sequence) const {
  const auto uniform = sequence.pair(0);
  const PixelPosition position{x + 0.5 + filter_.offset(static_cast<double>(uniform[0])),
                               y + 0.5 + filter_.offset(static_cast<double>(uniform[1]))};
  const Ray ray = rayThrough(view_, position);
  const Ray across = rayThrough(view_, {position.x + footprint_, position.y});
  const Ray down = rayThrough(view_, {position.x, position.y + footprint_});
  const auto mean = [](Vector3 a, Vector3 b) { return std::sqrt(length(a) * length(b)); };
  const double width = mean(across.origin - ray.origin, down.origin - ray.origin);
  const double spread = mean(across.direction - ray.direction, down.direction - ray.direction);
  // Single precision has to serve from here on: skip the empty way to the scene.
  const double skipped = std::max(0.0, dot(centre_ - ray.origin, ray.direction) - 1.001 * radius_);
  return {float3(ray.origin + skipped * ray.direction), float3(ray.direction),
          static_cast<float>(width + spread * skipped), static_cast<float>(spread)};
}

}  // namespace illum
