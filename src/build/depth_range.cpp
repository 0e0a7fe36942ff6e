#include "build/depth_range.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace illum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSingleViewRadians = 0.1;

Vector3 eyeOf(const ViewGeometry& view) {
  if (const auto* camera = std::get_if<PinholeCamera>(&view))
    return camera->objectFromCamera.translation;
  if (const auto* panorama = std::get_if<Panorama>(&view))
    return panorama->objectFromCamera.translation;
  return {};
}

double nearestEye(const std::vector<View>& views, std::size_t group) {
  double nearest = kInfinity;
  for (std::size_t g = 0; g < views.size(); ++g) {
    const double distance = length(eyeOf(views[g].geometry) - eyeOf(views[group].geometry));
    // Two views from one place need no depth to be carried into each other.
    if (g != group && distance > 0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

/// A plane's pixels are as wide as high only by choice: the smaller side counts.
double pixelOnWindow(const LightSlab& slab) {
  return std::min((slab.st.right - slab.st.left) / slab.size.width,
                  (slab.st.top - slab.st.bottom) / slab.size.height);
}

double gridSpacing(const LightSlab& slab) {
  const double u = slab.uCount > 1 ? (slab.uv.right - slab.uv.left) / (slab.uCount - 1) : 0;
  const double v = slab.vCount > 1 ? (slab.uv.top - slab.uv.bottom) / (slab.vCount - 1) : 0;
  return std::max(u, v);
}

/// A view point moved by b sees the point of depth z moved by b z / (d - z) on the window, the
/// derivative of which is b d / (d - z)^2: greatest at the greatest z.
double errorAllowed(const SlabView& view, double, double greatest, double) {
  const LightSlab& slab = view.slab;
  const double away = std::max(slab.distance - greatest, 1e-6 * slab.distance);
  const double spacing = gridSpacing(slab);
  const double step = spacing > 0 ? spacing : kSingleViewRadians * away;
  return pixelOnWindow(slab) * away * away / (step * slab.distance);
}

/// Seen from the side by 45 degrees, a step in depth is as long as one across.
double errorAllowed(const OrthographicView& view, double, double, double) {
  return 2.0 / std::max(view.size.width, view.size.height);
}

/// An eye moved by b sees a point at depth z moved by f b / z pixels, with the derivative f b /
/// z^2.
double errorAllowed(double focalPixels, double nearest, double eyeMoves) {
  const double away = std::max(nearest, 1e-9);
  const double moves = std::isfinite(eyeMoves) ? eyeMoves : kSingleViewRadians * away;
  return away * away / (focalPixels * moves);
}
double errorAllowed(const PinholeCamera& camera, double nearest, double, double eyeMoves) {
  return errorAllowed(std::max(camera.focalX, camera.focalY), nearest, eyeMoves);
}
double errorAllowed(const Panorama& panorama, double nearest, double, double eyeMoves) {
  const PlaneRectangle& extent = panorama.extent;
  const double focal = std::max(panorama.size.width / (extent.right - extent.left),
                                panorama.size.height / (extent.top - extent.bottom));
  return errorAllowed(focal, nearest, eyeMoves);
}

struct Extremes {
  double least = kInfinity, greatest = -kInfinity;
};

Extremes depthsOf(const Capture& capture, int group, const Rectangle& rows) {
  std::vector<float> depths(rows.pixels());
  capture.readDepth(group, rows, depths);
  Extremes found;
  for (const float depth : depths) {
    if (!std::isfinite(depth)) continue;
    found.least = std::min<double>(found.least, depth);
    found.greatest = std::max<double>(found.greatest, depth);
  }
  return found;
}

}  // namespace

DepthRange depthRangeFor(const std::vector<View>& views, int group, double from, double to) {
  const auto index = static_cast<std::size_t>(group);
  const bool slabOrPhotograph = std::holds_alternative<SlabView>(views[index].geometry) ||
                                std::holds_alternative<OrthographicView>(views[index].geometry);
  const double eyeMoves = slabOrPhotograph ? kInfinity : nearestEye(views, index);
  const double error =
      kDepthErrorPixels *
      std::visit([&](const auto& view) { return errorAllowed(view, from, to, eyeMoves); },
                 views[index].geometry);
  // Rounding to the nearest step is wrong by at most half of one.
  const double steps = std::ceil((to - from) / (2 * error));
  DepthRange range{from, to, 1};
  range.steps = steps >= kMaxDepthSteps ? kMaxDepthSteps : std::max(1, static_cast<int>(steps));
  return range;
}

DepthRange depthRangeOf(const Capture& capture, int group) {
  constexpr int kRows = 8;
  const Size size = capture.size(group);
  const int bands = (size.height + kRows - 1) / kRows;
  const Extremes all = tbb::parallel_reduce(
      tbb::blocked_range<int>(0, bands), Extremes(),
      [&](const tbb::blocked_range<int>& some, Extremes found) {
        for (int band = some.begin(); band < some.end(); ++band) {
          const Rectangle rows{0, band * kRows, size.width,
                               std::min(kRows, size.height - band * kRows)};
          const Extremes here = depthsOf(capture, group, rows);
          found.least = std::min(found.least, here.least);
          found.greatest = std::max(found.greatest, here.greatest);
        }
        return found;
      },
      [](const Extremes& a, const Extremes& b) {
        return Extremes{std::min(a.least, b.least), std::max(a.greatest, b.greatest)};
      });
  if (!(all.least <= all.greatest)) return {};
  return depthRangeFor(capture.views(), group, all.least, all.greatest);
}

}  // namespace illum
