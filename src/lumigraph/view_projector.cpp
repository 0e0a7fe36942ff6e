#include "lumigraph/view_projector.h"

#include <algorithm>
#include <numbers>

namespace illum {
namespace {

constexpr double kPhotographFrom = 1e3;  // far in front of objects that live about z = 0

double gridShare(int index, int count) {
  return count > 1 ? static_cast<double>(index) / (count - 1) : 0.5;
}

}  // namespace

ViewProjector::ViewProjector(const ViewGeometry& view) : size_(sizeOf(view)) {
  if (const auto* slab = std::get_if<SlabView>(&view)) {
    setPinhole(pinholeOf(slab->slab, gridShare(slab->u, slab->slab.uCount),
                         gridShare(slab->v, slab->slab.vCount)));
    // A slab's depth is z: largest at the eye.
    rangeOfZero_ = slab->slab.distance;
    rangePerDepth_ = -1;
  } else if (const auto* pinhole = std::get_if<PinholeCamera>(&view)) {
    setPinhole(*pinhole);
  } else if (const auto* panorama = std::get_if<Panorama>(&view)) {
    kind_ = Kind::Around;
    around_ = view;
    objectFromCamera_ = panorama->objectFromCamera;
    const double turn = panorama->extent.right - panorama->extent.left;
    wraps_ = turn > 2 * std::numbers::pi - 1e-6;
    widthPerRange_ = turn / size_.width;
  } else {
    kind_ = Kind::Parallel;
    objectFromCamera_.translation = {0, 0, kPhotographFrom};
    widthPerRange_ = 2.0 / std::max(size_.width, size_.height);
    rangeOfZero_ = kPhotographFrom;
    rangePerDepth_ = -1;
  }
  cameraFromObject_ = inverse(objectFromCamera_);
}

void ViewProjector::setPinhole(const PinholeCamera& camera) {
  objectFromCamera_ = camera.objectFromCamera;
  focalX_ = camera.focalX;
  focalY_ = camera.focalY;
  centre_ = camera.centre;
  widthPerRange_ = 1 / std::sqrt(std::abs(focalX_ * focalY_));
}

bool ViewProjector::seeAround(Vector3 point, Sighting& seen) const {
  const auto position = pixelOf(around_, point);
  if (!position) return false;
  seen = {position->x, position->y, length(point - eye())};
  return true;
}

Vector3 ViewProjector::pointAt(double x, double y, double range) const {
  switch (kind_) {
    case Kind::Perspective:
      return objectFromCamera_.point(
          {(x - centre_.x) / focalX_ * range, (centre_.y - y) / focalY_ * range, -range});
    case Kind::Parallel:
      return {(x - 0.5 * size_.width) * widthPerRange_, (0.5 * size_.height - y) * widthPerRange_,
              kPhotographFrom - range};
    case Kind::Around: {
      const Ray along = rayThrough(around_, {x, y});
      return along.origin + range * along.direction;
    }
  }
  return {};
}

Ray ViewProjector::ray(double x, double y) const {
  if (kind_ == Kind::Around) return rayThrough(around_, {x, y});
  if (kind_ == Kind::Parallel) return {pointAt(x, y, 0), {0, 0, -1}};
  return {eye(),
          objectFromCamera_.vector({(x - centre_.x) / focalX_, (centre_.y - y) / focalY_, -1})};
}

Vector3 ViewProjector::axis() const {
  const Vector3 along = ray(0.5 * size_.width, 0.5 * size_.height).direction;
  return (1 / length(along)) * along;
}

}  // namespace illum
