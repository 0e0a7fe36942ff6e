#include "object/view_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "illum/error.h"

namespace illum {
namespace {

// Above rounding to float, below what an eye would see.
constexpr double kRotationError = 1e-5;

[[noreturn]] void refuse(const std::string& what, const std::string& expected,
                         const std::string& found) {
  throw Error(Fault::Input, fmt::format("{}: expected {}, found {}", what, expected, found));
}

void checkRotation(const std::string& what, const RigidTransform& transform) {
  const RigidTransform back = inverse(transform);
  const RigidTransform product = back * transform;
  const auto identity = RigidTransform().rotation;
  double error = 0;  // added up, so that NaN stays
  for (std::size_t i = 0; i < 9; ++i) error += std::abs(product.rotation[i] - identity[i]);
  const Vector3 x = transform.vector({1, 0, 0}), y = transform.vector({0, 1, 0});
  const Vector3 z = transform.vector({0, 0, 1});
  if (!(error <= kRotationError)) refuse(what, "a rotation", "another matrix");
  if (dot(cross(x, y), z) < 0) refuse(what, "a rotation", "a mirroring");
}

void checkInside(const std::string& what, const PlaneRectangle& rectangle) {
  if (rectangle.left < rectangle.right && rectangle.bottom < rectangle.top) return;
  refuse(what, "left < right and bottom < top",
         fmt::format("{} to {}, {} to {}", rectangle.left, rectangle.right, rectangle.bottom,
                     rectangle.top));
}

void checkCamera(const PinholeCamera& camera) {
  checkRotation("camera", camera.objectFromCamera);
  if (!(camera.focalX > 0) || !(camera.focalY > 0)) {
    refuse("camera", "focal lengths above 0",
           fmt::format("{} and {}", camera.focalX, camera.focalY));
  }
}

void checkPanorama(const Panorama& panorama) {
  constexpr double kTurn = 2 * std::numbers::pi, kQuarter = std::numbers::pi / 2;
  constexpr double kRounding = 1e-9;
  checkRotation("panorama", panorama.objectFromCamera);
  checkInside("panorama", panorama.extent);
  const PlaneRectangle& extent = panorama.extent;
  if (extent.right - extent.left > kTurn + kRounding) {
    refuse("panorama", "at most a whole turn",
           fmt::format("{} radians", extent.right - extent.left));
  }
  if (panorama.projection == Panorama::Projection::Equirectangular &&
      std::max(-extent.bottom, extent.top) > kQuarter + kRounding) {
    refuse("panorama", "elevations within a quarter turn of the horizon",
           fmt::format("{} to {} radians", extent.bottom, extent.top));
  }
}

}  // namespace

ViewRecord recordOf(const ViewGeometry& view, std::vector<LightSlab>& slabs) {
  ViewRecord record;
  if (const auto* slab = std::get_if<SlabView>(&view)) {
    record.kind = ViewKind::Slab;
    auto at = std::find(slabs.begin(), slabs.end(), slab->slab);
    if (at == slabs.end()) at = slabs.insert(at, slab->slab);
    record.slab = static_cast<int>(at - slabs.begin());
    record.u = slab->u;
    record.v = slab->v;
  } else if (const auto* camera = std::get_if<PinholeCamera>(&view)) {
    record.kind = ViewKind::Camera;
    record.camera = *camera;
  } else if (const auto* panorama = std::get_if<Panorama>(&view)) {
    record.kind = ViewKind::Panorama;
    record.panorama = *panorama;
  } else {
    record.photograph = std::get<OrthographicView>(view);
  }
  return record;
}

ViewGeometry geometryOf(const ViewRecord& record, const std::vector<LightSlab>& slabs) {
  switch (record.kind) {
    case ViewKind::Photograph:
      return record.photograph;
    case ViewKind::Camera:
      return record.camera;
    case ViewKind::Panorama:
      return record.panorama;
    case ViewKind::Slab:
      break;
  }
  if (record.slab < 0 || record.slab >= static_cast<int>(slabs.size())) {
    refuse("view", fmt::format("a slab below {}", slabs.size()), fmt::format("{}", record.slab));
  }
  const LightSlab& slab = slabs[static_cast<std::size_t>(record.slab)];
  if (record.u < 0 || record.u >= slab.uCount || record.v < 0 || record.v >= slab.vCount) {
    refuse("view", fmt::format("a view point of {}x{}", slab.uCount, slab.vCount),
           fmt::format("({}, {})", record.u, record.v));
  }
  return SlabView{slab, record.u, record.v};
}

void checkSlab(const LightSlab& slab) {
  const std::string what = fmt::format("slab '{}'", slab.name);
  checkRotation(what, slab.objectFromSlab);
  checkInside(what + ", window st", slab.st);
  if (!(slab.distance > 0)) {
    refuse(what, "the uv plane before the window, distance > 0", fmt::format("{}", slab.distance));
  }
  if ((slab.uCount > 1 && !(slab.uv.left < slab.uv.right)) ||
      (slab.vCount > 1 && !(slab.uv.bottom < slab.uv.top))) {
    refuse(what + ", view points uv", "left < right and bottom < top",
           fmt::format("{} to {}, {} to {}", slab.uv.left, slab.uv.right, slab.uv.bottom,
                       slab.uv.top));
  }
}

void checkGeometry(const ViewGeometry& view) {
  if (const auto* slab = std::get_if<SlabView>(&view)) checkSlab(slab->slab);
  if (const auto* camera = std::get_if<PinholeCamera>(&view)) checkCamera(*camera);
  if (const auto* panorama = std::get_if<Panorama>(&view)) checkPanorama(*panorama);
}

}  // namespace illum
