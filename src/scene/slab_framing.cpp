#include "scene/slab_framing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "illum/error.h"

namespace illum {
namespace {

constexpr double kDistanceInRadii = 4;  // far enough for a calm perspective
constexpr double kMargin = 0.03;        // around the scene, of the window's longer side

Vector3 middleOf(const Bounds& bounds) {
  return 0.5 * (bounds.low + bounds.high);
}

double radiusOf(const Bounds& bounds) {
  return 0.5 * length(bounds.high - bounds.low);
}

/// Widens a rectangle as the views of a slab need it.
class Window {
 public:
  Window(const RigidTransform& objectFromSlab, const PlaneRectangle& uv, double distance)
      : slabFromObject_(inverse(objectFromSlab)),
        distance_(distance),
        eyes_{{{uv.left, uv.bottom, distance},
               {uv.left, uv.top, distance},
               {uv.right, uv.bottom, distance},
               {uv.right, uv.top, distance}}} {}

  /// A sphere is taken as the square that holds it; exact for points.
  void include(Vector3 point, double radius) {
    const Vector3 p = slabFromObject_.point(point);
    const double near = p.z + radius;
    if (!(near < distance_)) {
      inside_ = true;
      return;
    }
    for (const Vector3& eye : eyes_) {
      const double share = distance_ / (distance_ - near);  // of the way from the eye to z = 0
      const double s = eye.x + share * (p.x - eye.x), t = eye.y + share * (p.y - eye.y);
      window_ = {
          std::min(window_.left, s - share * radius), std::min(window_.bottom, t - share * radius),
          std::max(window_.right, s + share * radius), std::max(window_.top, t + share * radius)};
    }
  }
  bool reachesTheEyes() const { return inside_; }
  PlaneRectangle withMargin() const {
    const double margin =
        kMargin * std::max(window_.right - window_.left, window_.top - window_.bottom);
    return {window_.left - margin, window_.bottom - margin, window_.right + margin,
            window_.top + margin};
  }

 private:
  RigidTransform slabFromObject_;
  double distance_;
  std::array<Vector3, 4> eyes_;
  PlaneRectangle window_{
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
      -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  bool inside_ = false;
};

PlaneRectangle windowOf(const LightSlab& slab, const Scene& scene) {
  Window window(slab.objectFromSlab, slab.uv, slab.distance);
  for (const TriangleMesh& mesh : scene.meshes) {
    for (const auto& p : mesh.positions) window.include({p[0], p[1], p[2]}, 0);
  }
  for (const CurveSet& set : scene.curves) {
    for (const auto& p : set.points) window.include({p[0], p[1], p[2]}, p[3]);
  }
  if (window.reachesTheEyes()) {
    throw Error(Fault::Input,
                fmt::format("slab '{}': expected view points in front of the whole scene, found a "
                            "part of it at or behind them; give it a larger 'distance', or a "
                            "'window' of its own",
                            slab.name));
  }
  return window.withMargin();
}

/// Square pixels: the longer side has so many, the window's shorter side grows by less than one.
void chooseSize(LightSlab& slab, int longerSide) {
  const double width = slab.st.right - slab.st.left, height = slab.st.top - slab.st.bottom;
  const double pixel = std::max(width, height) / longerSide;
  slab.size = {std::max(1, static_cast<int>(std::ceil(width / pixel - 1e-9))),
               std::max(1, static_cast<int>(std::ceil(height / pixel - 1e-9)))};
  const double moreX = 0.5 * (slab.size.width * pixel - width);
  const double moreY = 0.5 * (slab.size.height * pixel - height);
  slab.st = {slab.st.left - moreX, slab.st.bottom - moreY, slab.st.right + moreX,
             slab.st.top + moreY};
}

/// A given size keeps square pixels too: the window grows in one direction.
void fitWindow(LightSlab& slab) {
  const double width = slab.st.right - slab.st.left, height = slab.st.top - slab.st.bottom;
  const double pixel = std::max(width / slab.size.width, height / slab.size.height);
  const double moreX = 0.5 * (slab.size.width * pixel - width);
  const double moreY = 0.5 * (slab.size.height * pixel - height);
  slab.st = {slab.st.left - moreX, slab.st.bottom - moreY, slab.st.right + moreX,
             slab.st.top + moreY};
}

void chooseSize(LightSlab& slab, const SlabPlan& plan) {
  if (!plan.size) {
    chooseSize(slab, plan.longerSide);
  } else {
    slab.size = *plan.size;
    if (!plan.st) fitWindow(slab);
  }
}

RigidTransform frameOf(const SlabPlan& plan, const Bounds& bounds) {
  if (plan.objectFromSlab) return *plan.objectFromSlab;
  const Vector3 middle = middleOf(bounds);
  RigidTransform frame = lookAt(middle + plan.toward, middle, plan.up);
  frame.translation = middle;
  return frame;
}

/// All but window and size.
LightSlab placedSlab(const SlabPlan& plan, const Bounds& bounds) {
  LightSlab slab;
  slab.name = plan.name;
  slab.uCount = plan.uCount;
  slab.vCount = plan.vCount;
  slab.objectFromSlab = frameOf(plan, bounds);
  slab.distance = plan.distance.value_or(kDistanceInRadii * radiusOf(bounds));
  const double u = slab.distance * std::tan(plan.uRadians / 2);
  const double v = slab.distance * std::tan(plan.vRadians / 2);
  slab.uv = plan.uv.value_or(PlaneRectangle{-u, -v, u, v});
  return slab;
}

PlaneRectangle unionOf(const PlaneRectangle& a, const PlaneRectangle& b) {
  return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right),
          std::max(a.top, b.top)};
}

}  // namespace

LightSlab framedSlab(const SlabPlan& plan, const Scene& scene) {
  LightSlab slab = placedSlab(plan, boundsOf(scene));
  slab.st = plan.st ? *plan.st : windowOf(slab, scene);
  chooseSize(slab, plan);
  return slab;
}

Vector3 towardOf(const TurnPlan& plan, int i) {
  const double azimuth = i * 2 * std::numbers::pi / plan.slabs;
  const double elevation = plan.elevationRadians;
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          std::cos(elevation) * std::cos(azimuth)};
}

std::vector<LightSlab> framedTurn(const TurnPlan& plan, const Scene& scene) {
  const Bounds bounds = boundsOf(scene);
  const double step = 2 * std::numbers::pi / plan.slabs;
  std::vector<LightSlab> slabs;
  for (int i = 0; i < plan.slabs; ++i) {
    SlabPlan one = plan.slab;
    one.objectFromSlab.reset();
    one.toward = towardOf(plan, i);
    if (plan.joined && plan.slabs > 2) one.uRadians = step;
    one.name = fmt::format("{}_{}", plan.slab.name, i);
    slabs.push_back(placedSlab(one, bounds));
    slabs.back().st = one.st ? *one.st : windowOf(slabs.back(), scene);
  }
  PlaneRectangle all = slabs.front().st;
  for (const LightSlab& slab : slabs) all = unionOf(all, slab.st);
  for (LightSlab& slab : slabs) {
    slab.st = all;
    chooseSize(slab, plan.slab);
  }
  return slabs;
}

}  // namespace illum
