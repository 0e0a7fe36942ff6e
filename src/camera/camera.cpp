#include "illum/camera.h"

#include <algorithm>
#include <cmath>

namespace illum {
namespace {

double between(double from, double to, double share) {
  return from + (to - from) * share;
}

// --- orthographic ---

// Half the longer side is 1.
double unitsPerPixel(const OrthographicView& view) {
  return 2.0 / std::max(view.size.width, view.size.height);
}

Ray rayOf(const OrthographicView& view, PixelPosition p) {
  // Objects of photographs live about z = 0; the start only has to be in front of all of them.
  constexpr double kInFront = 1e3;
  const double unit = unitsPerPixel(view);
  return {{(p.x - 0.5 * view.size.width) * unit, (0.5 * view.size.height - p.y) * unit, kInFront},
          {0, 0, -1}};
}

std::optional<PixelPosition> pixelIn(const OrthographicView& view, Vector3 point) {
  const double unit = unitsPerPixel(view);
  return PixelPosition{point.x / unit + 0.5 * view.size.width,
                       0.5 * view.size.height - point.y / unit};
}

double depthIn(const OrthographicView&, Vector3 point) {
  return point.z;
}

// --- slab ---

Vector3 viewPointOf(const SlabView& view) {
  const LightSlab& slab = view.slab;
  const double u = slab.uCount > 1 ? static_cast<double>(view.u) / (slab.uCount - 1) : 0.5;
  const double v = slab.vCount > 1 ? static_cast<double>(view.v) / (slab.vCount - 1) : 0.5;
  return slab.viewPoint(u, v);
}

Vector3 windowPoint(const LightSlab& slab, PixelPosition p) {
  return {between(slab.st.left, slab.st.right, p.x / slab.size.width),
          between(slab.st.top, slab.st.bottom, p.y / slab.size.height), 0};
}

Ray rayOf(const SlabView& view, PixelPosition p) {
  const Vector3 eye = viewPointOf(view);
  const Vector3 along = windowPoint(view.slab, p) - eye;
  return {view.slab.objectFromSlab.point(eye),
          view.slab.objectFromSlab.vector((1 / length(along)) * along)};
}

std::optional<PixelPosition> pixelIn(const SlabView& view, Vector3 point) {
  const LightSlab& slab = view.slab;
  const Vector3 eye = viewPointOf(view);
  const Vector3 p = inverse(slab.objectFromSlab).point(point);
  if (p.z >= eye.z) return std::nullopt;
  const double share = eye.z / (eye.z - p.z);  // of the way from the eye, where z = 0
  const double s = between(eye.x, p.x, share), t = between(eye.y, p.y, share);
  return PixelPosition{(s - slab.st.left) / (slab.st.right - slab.st.left) * slab.size.width,
                       (slab.st.top - t) / (slab.st.top - slab.st.bottom) * slab.size.height};
}

double depthIn(const SlabView& view, Vector3 point) {
  return inverse(view.slab.objectFromSlab).point(point).z;
}

// --- pinhole ---

Ray rayOf(const PinholeCamera& camera, PixelPosition p) {
  const Vector3 along{(p.x - camera.centre.x) / camera.focalX,
                      (camera.centre.y - p.y) / camera.focalY, -1};
  return {camera.objectFromCamera.translation,
          camera.objectFromCamera.vector((1 / length(along)) * along)};
}

std::optional<PixelPosition> pixelIn(const PinholeCamera& camera, Vector3 point) {
  const Vector3 p = inverse(camera.objectFromCamera).point(point);
  if (p.z >= 0) return std::nullopt;
  return PixelPosition{camera.centre.x - camera.focalX * p.x / p.z,
                       camera.centre.y + camera.focalY * p.y / p.z};
}

double depthIn(const PinholeCamera& camera, Vector3 point) {
  return -inverse(camera.objectFromCamera).point(point).z;
}

// --- panorama ---

Ray rayOf(const Panorama& panorama, PixelPosition p) {
  const PlaneRectangle& extent = panorama.extent;
  const double azimuth = between(extent.left, extent.right, p.x / panorama.size.width);
  const double height = between(extent.top, extent.bottom, p.y / panorama.size.height);
  const double elevation =
      panorama.projection == Panorama::Projection::Equirectangular ? height : std::atan(height);
  const Vector3 along{std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                      -std::cos(azimuth) * std::cos(elevation)};
  return {panorama.objectFromCamera.translation, panorama.objectFromCamera.vector(along)};
}

std::optional<PixelPosition> pixelIn(const Panorama& panorama, Vector3 point) {
  constexpr double kTurn = 6.28318530717958647693;
  const PlaneRectangle& extent = panorama.extent;
  const Vector3 p = inverse(panorama.objectFromCamera).point(point);
  const double across = std::hypot(p.x, p.z);
  if (across == 0 && (p.y == 0 || panorama.projection == Panorama::Projection::Cylindrical)) {
    return std::nullopt;
  }
  double azimuth = across == 0 ? extent.left : std::atan2(p.x, -p.z);
  // The turn in which the picture shows it.
  azimuth += kTurn * std::ceil((extent.left - azimuth) / kTurn);
  const double height = panorama.projection == Panorama::Projection::Equirectangular
                            ? std::atan2(p.y, across)
                            : p.y / across;
  return PixelPosition{(azimuth - extent.left) / (extent.right - extent.left) * panorama.size.width,
                       (extent.top - height) / (extent.top - extent.bottom) * panorama.size.height};
}

double depthIn(const Panorama& panorama, Vector3 point) {
  return length(point - panorama.objectFromCamera.translation);
}

}  // namespace

Vector3 LightSlab::viewPoint(double u, double v) const {
  return {between(uv.left, uv.right, uCount > 1 ? u : 0.5),
          between(uv.bottom, uv.top, vCount > 1 ? v : 0.5), distance};
}

Size sizeOf(const ViewGeometry& view) {
  if (const auto* slab = std::get_if<SlabView>(&view)) return slab->slab.size;
  if (const auto* pinhole = std::get_if<PinholeCamera>(&view)) return pinhole->size;
  if (const auto* panorama = std::get_if<Panorama>(&view)) return panorama->size;
  return std::get<OrthographicView>(view).size;
}

RigidTransform objectFromGroup(const ViewGeometry& view) {
  if (const auto* slab = std::get_if<SlabView>(&view)) return slab->slab.objectFromSlab;
  return {};
}

Ray rayThrough(const ViewGeometry& view, PixelPosition position) {
  return std::visit([&](const auto& v) { return rayOf(v, position); }, view);
}

std::optional<PixelPosition> pixelOf(const ViewGeometry& view, Vector3 point) {
  return std::visit([&](const auto& v) { return pixelIn(v, point); }, view);
}

double depthOf(const ViewGeometry& view, Vector3 point) {
  return std::visit([&](const auto& v) { return depthIn(v, point); }, view);
}

Vector3 pointAt(const ViewGeometry& view, PixelPosition position, double depth) {
  const Ray ray = rayThrough(view, position);
  // Depth is linear along a ray: two of its points determine the rest.
  const double atOrigin = depthOf(view, ray.origin);
  const double atUnit = depthOf(view, ray.origin + ray.direction);
  const double distance = (depth - atOrigin) / (atUnit - atOrigin);
  return ray.origin + distance * ray.direction;
}

PinholeCamera pinholeOf(const LightSlab& slab, double u, double v) {
  const Vector3 eye = slab.viewPoint(u, v);
  PinholeCamera camera;
  camera.objectFromCamera = slab.objectFromSlab;
  camera.objectFromCamera.translation = slab.objectFromSlab.point(eye);
  camera.size = slab.size;
  const double pixelsPerX = slab.size.width / (slab.st.right - slab.st.left);
  const double pixelsPerY = slab.size.height / (slab.st.top - slab.st.bottom);
  camera.focalX = slab.distance * pixelsPerX;
  camera.focalY = slab.distance * pixelsPerY;
  camera.centre = {(eye.x - slab.st.left) * pixelsPerX, (slab.st.top - eye.y) * pixelsPerY};
  return camera;
}

LightSlab slabOf(const PinholeCamera& camera, double distance) {
  LightSlab slab;
  slab.objectFromSlab = camera.objectFromCamera;
  slab.objectFromSlab.translation = camera.objectFromCamera.point({0, 0, -distance});
  slab.distance = distance;
  slab.uv = {0, 0, 0, 0};
  slab.size = camera.size;
  const double perPixelX = distance / camera.focalX, perPixelY = distance / camera.focalY;
  slab.st = {-camera.centre.x * perPixelX, (camera.centre.y - camera.size.height) * perPixelY,
             (camera.size.width - camera.centre.x) * perPixelX, camera.centre.y * perPixelY};
  return slab;
}

}  // namespace illum
