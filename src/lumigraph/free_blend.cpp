#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lumigraph/blend_rule.h"
#include "lumigraph/view_samples.h"

namespace illum {
namespace {

constexpr int kMostBlended = 64;
constexpr int kWideFactor = 4;
// Against an angle in radians: what twice as coarse a view is worth.
constexpr double kResolutionShare = 0.1;
// Keeps the weight of a view that sees the ray itself finite, and above all others.
constexpr double kLeastPenalty = 1e-9;

// The least `count` penalties, ascending.
class LeastPenalties {
 public:
  explicit LeastPenalties(int count) : count_(static_cast<std::size_t>(count)) {}
  void add(double penalty) {
    if (filled_ == count_ && penalty >= values_[filled_ - 1]) return;
    std::size_t at = filled_ < count_ ? filled_++ : filled_ - 1;
    for (; at > 0 && values_[at - 1] > penalty; --at) values_[at] = values_[at - 1];
    values_[at] = penalty;
  }
  /// The greatest of them; infinity while there are fewer.
  double last() const { return filled_ == count_ ? values_[filled_ - 1] : kNothing; }

 private:
  std::size_t count_, filled_ = 0;
  std::array<double, kWideFactor * kMostBlended + 1> values_;
};

class FreeBlend final : public BlendRule {
 public:
  FreeBlend(const ViewProjector& target, std::span<const ViewProjector* const> views,
            const SurfacePoints& points, int blendedViews)
      : target_(target),
        views_(views.begin(), views.end()),
        points_(points),
        thresholds_{thresholds(blendedViews), thresholds(kWideFactor * blendedViews)} {}

  void weights(int view, int y, Ring ring, std::span<float> weights) const override {
    const auto points = points_.row(y);
    const auto thresholds = thresholds_[ring == Ring::Near ? 0 : 1].row(y);
    for (std::size_t x = 0; x < weights.size(); ++x) {
      const double penalty = penaltyOf(*views_[static_cast<std::size_t>(view)], points[x]);
      weights[x] = static_cast<float>(weightOf(penalty, thresholds[x]));
    }
  }

 private:
  // Buehler et al. 2001, equation 1 and what follows: 0 from the first view that is not blended on.
  static double weightOf(double penalty, double threshold) {
    if (!(penalty < threshold)) return 0;
    const double share = std::isinf(threshold) ? 1 : 1 - penalty / threshold;
    return share / std::max(penalty, kLeastPenalty);
  }

  // The angle between the rays on which view and target see the point, in radians, and how much
  // coarser the view sees it; more toward the view's frame, infinite outside. Multiplied, not added
  // as in the paper, so that a view of the very same ray is perfect up to its frame.
  double penaltyOf(const ViewProjector& view, Vector3 point) const {
    Sighting seen, wanted;
    if (!std::isfinite(point.x) || !view.see(point, seen)) return kNothing;
    const double fade = frameFade(view, seen);
    if (fade == 0 || !target_.see(point, wanted)) return kNothing;
    const Vector3 toView = view.towardEye(point), toTarget = target_.towardEye(point);
    const double angle = std::atan2(length(cross(toView, toTarget)), dot(toView, toTarget));
    const double coarser = view.pixelWidth(seen.range) / target_.pixelWidth(wanted.range) - 1;
    return (angle + kResolutionShare * angle * std::max(0.0, coarser)) / fade;
  }

  PictureOf<double> thresholds(int blended) const {
    PictureOf<double> result(points_.size, 1);
    tbb::parallel_for(0, points_.size.height, [&](int y) {
      const auto points = points_.row(y);
      for (int x = 0; x < points_.size.width; ++x) {
        LeastPenalties least(blended + 1);
        for (const ViewProjector* view : views_) {
          const double penalty = penaltyOf(*view, points[static_cast<std::size_t>(x)]);
          if (std::isfinite(penalty)) least.add(penalty);
        }
        result.at(x, y, 0) = least.last();
      }
    });
    return result;
  }

  const ViewProjector& target_;
  std::vector<const ViewProjector*> views_;
  SurfacePoints points_;
  std::array<PictureOf<double>, 2> thresholds_;
};

}  // namespace

std::unique_ptr<BlendRule> freeBlend(const ViewProjector& target,
                                     std::span<const ViewProjector* const> views,
                                     const SurfacePoints& points, int blendedViews) {
  return std::make_unique<FreeBlend>(target, views, points, blendedViews);
}

}  // namespace illum
