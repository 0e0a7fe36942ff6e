#include <tbb/parallel_for.h>

#include <algorithm>
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
  SlabBlend(const ViewProjector& target, std::span<const SlabView> views, double apertureRadius)
      : slab_(views.front().slab),
        views_(views.begin(), views.end()),
        apertureRadius_(apertureRadius),
        crossings_(target.size(), 3) {
    const RigidTransform slabFromObject = inverse(slab_.objectFromSlab);
    tbb::parallel_for(0, target.size().height, [&](int y) {
      for (int x = 0; x < target.size().width; ++x) {
        const Ray ray = target.ray(x + 0.5, y + 0.5);
        setCrossing(x, y, slabFromObject.point(ray.origin), slabFromObject.vector(ray.direction));
      }
    });
  }

  void weights(int view, int y, Ring ring, std::span<float> weights) const override {
    const SlabView& at = views_[static_cast<std::size_t>(view)];
    const auto crossings = crossings_.row(y);
    for (std::size_t x = 0; x < weights.size(); ++x) {
      const float* crossing = &crossings[3 * x];
      weights[x] = 0;
      if (crossing[2] <= 0) continue;
      const double cellsU = slab_.uCount > 1 ? crossing[0] - at.u : 0;
      const double cellsV = slab_.vCount > 1 ? crossing[1] - at.v : 0;
      weights[x] = crossing[2] * static_cast<float>(kernel(cellsU, cellsV, ring));
    }
  }

 private:
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

  double kernel(double cellsU, double cellsV, Ring ring) const {
    if (ring == Ring::Wide) return tent(cellsU, kWideCells) * tent(cellsV, kWideCells);
    if (apertureRadius_ == 0) return tent(cellsU, 1) * tent(cellsV, 1);
    const double cellU = cellSize(slab_.uv.right - slab_.uv.left, slab_.uCount);
    const double cellV = cellSize(slab_.uv.top - slab_.uv.bottom, slab_.vCount);
    // A disc whose edge is one cell wide, so that however small it is some view point lies in it.
    const double edge = std::max(cellU, cellV);
    const double away = std::hypot(cellsU * cellU, cellsV * cellV);
    return std::clamp((apertureRadius_ + edge - away) / edge, 0.0, 1.0);
  }
  static double cellSize(double extent, int count) { return count > 1 ? extent / (count - 1) : 0; }

  LightSlab slab_;
  std::vector<SlabView> views_;
  double apertureRadius_;
  Picture crossings_;  // u, v in cells, weight of the slab (0: not crossed)
};

}  // namespace

std::unique_ptr<BlendRule> slabBlend(const ViewProjector& target, std::span<const SlabView> views,
                                     double apertureRadius) {
  return std::make_unique<SlabBlend>(target, views, apertureRadius);
}

}  // namespace illum
