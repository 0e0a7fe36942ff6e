#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "lumigraph/blend_rule.h"

namespace illum {
namespace {

constexpr double kEdge = 1e-6;      // of a cell: rays that meet the border of the grid are inside
constexpr double kWideCells = 2.5;  // reach of the wide ring
constexpr float kLeastFeather = 1e-4F;  // at the border of the grid, against another slab

// The bilinear kernel, widened to `reach` cells.
double tent(double cells, double reach) {
  return std::max(0.0, 1 - std::abs(cells) / reach);
}

class SlabBlend final : public BlendRule {
 public:
  SlabBlend(const ViewProjector& target, std::span<const SlabView> views,
            const SurfacePoints& points, double apertureRadius)
      : target_(target),
        slab_(views.front().slab),
        slabFromObject_(inverse(slab_.objectFromSlab)),
        views_(views.begin(), views.end()),
        points_(points),
        apertureRadius_(apertureRadius),
        crossings_(target.size(), 3),
        crossed_(static_cast<std::size_t>(target.size().height)) {
    tbb::parallel_for(0, target.size().height, [&](int y) {
      for (int x = 0; x < target.size().width; ++x) {
        const Ray ray = target.ray(x + 0.5, y + 0.5);
        setCrossing(x, y, slabFromObject_.point(ray.origin), slabFromObject_.vector(ray.direction));
      }
      crossed_[static_cast<std::size_t>(y)] = cellsOf(y);
      if (passesWindow(y)) passesWindow_ = true;
    });
  }

  void weights(int view, int y, Ring ring, std::span<float> weights) const override {
    const SlabView& at = views_[static_cast<std::size_t>(view)];
    const auto crossings = crossings_.row(y);
    const auto points = points_.row(y);
    for (std::size_t x = 0; x < weights.size(); ++x) {
      const float* crossing = &crossings[3 * x];
      weights[x] = 0;
      if (crossing[2] <= 0) continue;
      double u = crossing[0], v = crossing[1];
      if (ring == Ring::Wide) moveToWhereSeen(points[x], u, v);
      const double cellsU = slab_.uCount > 1 ? u - at.u : 0;
      const double cellsV = slab_.vCount > 1 ? v - at.v : 0;
      weights[x] = crossing[2] * static_cast<float>(kernel(cellsU, cellsV, ring));
    }
  }

  bool asks(int view, int y, Ring ring) const override {
    const SlabView& at = views_[static_cast<std::size_t>(view)];
    const Cells& row = crossed_[static_cast<std::size_t>(y)];
    if (ring == Ring::Wide) return row.left <= row.right;
    const double u = reach(slab_.uv.right - slab_.uv.left, slab_.uCount);
    const double v = reach(slab_.uv.top - slab_.uv.bottom, slab_.vCount);
    return at.u > row.left - u && at.u < row.right + u && at.v > row.bottom - v &&
           at.v < row.top + v;
  }

  // Beside the window, the corners of the grid see farthest.
  std::vector<int> outposts() const override {
    std::vector<int> corners;
    for (std::size_t i = 0; i < views_.size() && passesWindow_; ++i) {
      const bool side = views_[i].u == 0 || views_[i].u == slab_.uCount - 1;
      if (side && (views_[i].v == 0 || views_[i].v == slab_.vCount - 1))
        corners.push_back(static_cast<int>(i));
    }
    return corners;
  }

 private:
  // What a row of pixels crosses of the grid; nothing: empty.
  struct Cells {
    double left = kNothing, right = -kNothing, bottom = kNothing, top = -kNothing;
  };

  Cells cellsOf(int y) const {
    Cells cells;
    const auto crossings = crossings_.row(y);
    for (std::size_t i = 0; i < crossings.size(); i += 3) {
      if (crossings[i + 2] <= 0) continue;
      cells.left = std::min<double>(cells.left, crossings[i]);
      cells.right = std::max<double>(cells.right, crossings[i]);
      cells.bottom = std::min<double>(cells.bottom, crossings[i + 1]);
      cells.top = std::max<double>(cells.top, crossings[i + 1]);
    }
    return cells;
  }

  // Whether a ray of the row crosses the grid, but not the window.
  bool passesWindow(int y) const {
    for (int x = 0; x < target_.size().width; ++x) {
      if (crossings_.at(x, y, 2) <= 0) continue;
      const Ray ray = target_.ray(x + 0.5, y + 0.5);
      const Vector3 origin = slabFromObject_.point(ray.origin);
      const Vector3 along = slabFromObject_.vector(ray.direction);
      const Vector3 p = origin - (origin.z / along.z) * along;
      if (p.x < slab_.st.left || p.x > slab_.st.right || p.y < slab_.st.bottom ||
          p.y > slab_.st.top)
        return true;
    }
    return false;
  }

  // Where the whole line meets the uv plane, in cells of the grid from the lower left view point:
  // the eye may be behind that plane, before it, or beyond the window.
  void setCrossing(int x, int y, Vector3 origin, Vector3 along) {
    if (!(along.z < 0)) return;  // looks away from the window
    const double steps = (slab_.distance - origin.z) / along.z;
    const double u = cell(origin.x + steps * along.x, slab_.uv.left, slab_.uv.right, slab_.uCount);
    const double v = cell(origin.y + steps * along.y, slab_.uv.bottom, slab_.uv.top, slab_.vCount);
    const double inside = std::min(room(u, slab_.uCount), room(v, slab_.vCount));
    if (!(inside >= -kEdge)) return;
    crossings_.at(x, y, 0) = static_cast<float>(std::clamp(u, 0.0, slab_.uCount - 1.0));
    crossings_.at(x, y, 1) = static_cast<float>(std::clamp(v, 0.0, slab_.vCount - 1.0));
    // Where slabs overlap, each fades within its last cell.
    crossings_.at(x, y, 2) = std::max(kLeastFeather, static_cast<float>(std::min(1.0, inside)));
  }
  static double cell(double position, double low, double high, int count) {
    return count > 1 ? (position - low) / (high - low) * (count - 1) : 0;
  }
  // To the nearest border. One view point sees no parallax that way, and has no border.
  static double room(double cells, int count) {
    return count > 1 ? std::min(cells, count - 1 - cells) : 1;
  }

  // The nearest place of the grid from which the point is seen through the window, at whose edge
  // the view points around the ray itself may see less than the ray. In cells.
  void moveToWhereSeen(Vector3 point, double& u, double& v) const {
    const Vector3 p = slabFromObject_.point(point);
    if (!(p.z < slab_.distance)) return;
    // From e, the point is seen at e + share (p - e) of the window.
    const double share = slab_.distance / (slab_.distance - p.z);
    moveInto(slab_.st.left, slab_.st.right, p.x, share, slab_.uv.left, slab_.uv.right, slab_.uCount,
             u);
    moveInto(slab_.st.bottom, slab_.st.top, p.y, share, slab_.uv.bottom, slab_.uv.top, slab_.vCount,
             v);
  }
  static void moveInto(double windowLow, double windowHigh, double p, double share, double low,
                       double high, int count, double& cells) {
    if (count == 1 || share == 1) return;
    const double one = (windowLow - share * p) / (1 - share);
    const double other = (windowHigh - share * p) / (1 - share);
    const double first = std::max(0.0, cell(std::min(one, other), low, high, count));
    const double last = std::min(count - 1.0, cell(std::max(one, other), low, high, count));
    if (first <= last) cells = std::clamp(cells, first, last);
  }

  double kernel(double cellsU, double cellsV, Ring ring) const {
    if (ring == Ring::Wide) return tent(cellsU, kWideCells) * tent(cellsV, kWideCells);
    if (apertureRadius_ == 0) return tent(cellsU, 1) * tent(cellsV, 1);
    const double cellU = cellSize(slab_.uv.right - slab_.uv.left, slab_.uCount);
    const double cellV = cellSize(slab_.uv.top - slab_.uv.bottom, slab_.vCount);
    const double away = std::hypot(cellsU * cellU, cellsV * cellV);
    return std::clamp((apertureRadius_ + apertureEdge() - away) / apertureEdge(), 0.0, 1.0);
  }
  // A disc whose edge is one cell wide, so that however small it is some view point lies in it.
  double apertureEdge() const {
    return std::max(cellSize(slab_.uv.right - slab_.uv.left, slab_.uCount),
                    cellSize(slab_.uv.top - slab_.uv.bottom, slab_.vCount));
  }
  // Cells from which on the kernel is 0; one view point along an axis is asked from anywhere.
  double reach(double extent, int count) const {
    if (count == 1) return kNothing;
    return apertureRadius_ == 0 ? 1 : (apertureRadius_ + apertureEdge()) / cellSize(extent, count);
  }
  static double cellSize(double extent, int count) { return count > 1 ? extent / (count - 1) : 0; }

  const ViewProjector& target_;
  LightSlab slab_;
  RigidTransform slabFromObject_;
  std::vector<SlabView> views_;
  const SurfacePoints& points_;
  double apertureRadius_;
  Picture crossings_;           // u, v in cells, weight of the slab (0: not crossed)
  std::vector<Cells> crossed_;  // by each row
  std::atomic<bool> passesWindow_ = false;
};

}  // namespace

std::unique_ptr<BlendRule> slabBlend(const ViewProjector& target, std::span<const SlabView> views,
                                     const SurfacePoints& points, double apertureRadius) {
  return std::make_unique<SlabBlend>(target, views, points, apertureRadius);
}

}  // namespace illum
