#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lumigraph/blend_rule.h"
#include "lumigraph/view_samples.h"

namespace illum {
namespace {

constexpr std::size_t kMostBlended = 64;
constexpr std::size_t kWideFactor = 4;
// Against an angle in radians: what twice as coarse a view is worth.
constexpr double kResolutionShare = 0.1;
// Keeps the weight of a view that sees the ray itself finite, and above all others.
constexpr double kLeastPenalty = 1e-9;

// The least `count` penalties, ascending, and whose they are.
class LeastPenalties {
 public:
  explicit LeastPenalties(std::size_t count) : count_(count) {}
  void add(double penalty, std::size_t view) {
    if (penalty >= last()) return;
    std::size_t at = filled_ < count_ ? filled_++ : filled_ - 1;
    for (; at > 0 && values_[at - 1].penalty > penalty; --at) values_[at] = values_[at - 1];
    values_[at] = {penalty, view};
  }
  void clear() { filled_ = 0; }
  std::size_t size() const { return filled_; }
  std::size_t view(std::size_t place) const { return values_[place].view; }
  /// Infinity where there are fewer.
  double penalty(std::size_t place) const {
    return place < filled_ ? values_[place].penalty : kNothing;
  }
  double last() const { return penalty(count_ - 1); }

 private:
  struct Entry {
    double penalty = 0;
    std::size_t view = 0;
  };
  std::size_t count_, filled_ = 0;
  std::array<Entry, kWideFactor * kMostBlended + 1> values_;
};

class FreeBlend final : public BlendRule {
 public:
  FreeBlend(const ViewProjector& target, std::span<const ViewProjector* const> views,
            const SurfacePoints& points, int blendedViews)
      : target_(target), views_(views.begin(), views.end()), points_(points) {
    const auto blended = static_cast<std::size_t>(blendedViews);
    for (const Ring ring : {Ring::Near, Ring::Wide}) {
      RingViews& of = rings_[index(ring)];
      of.count = ring == Ring::Near ? blended : kWideFactor * blended;
      of.thresholds = PictureOf<double>(points.size, 1);
      of.asked.assign(views_.size() * static_cast<std::size_t>(points.size.height), 0);
    }
    tbb::parallel_for(0, points.size.height, [&](int y) { rankViews(y); });
  }

  void weights(int view, int y, Ring ring, std::span<float> weights) const override {
    const auto points = points_.row(y);
    const auto thresholds = rings_[index(ring)].thresholds.row(y);
    for (std::size_t x = 0; x < weights.size(); ++x) {
      const double threshold = thresholds[x];
      const double penalty = penaltyOf(*views_[static_cast<std::size_t>(view)], points[x],
                                       wantedAt(points[x]), threshold);
      weights[x] = static_cast<float>(weightOf(penalty, threshold));
    }
  }

  bool asks(int view, int y, Ring ring) const override {
    return rings_[index(ring)].asked[rowOf(y) + static_cast<std::size_t>(view)] != 0;
  }

 private:
  // How the target sees a point.
  struct Wanted {
    bool isSeen = false;
    Vector3 toTarget;
    double pixelWidth = 0;
  };
  struct RingViews {
    std::size_t count = 0;            // how many are blended
    PictureOf<double> thresholds;     // penalty of the first that is not
    std::vector<std::uint8_t> asked;  // row by row: whether each view counts somewhere
  };

  static std::size_t index(Ring ring) { return ring == Ring::Near ? 0 : 1; }
  std::size_t rowOf(int y) const { return static_cast<std::size_t>(y) * views_.size(); }

  // Buehler et al. 2001, equation 1 and what follows: 0 from the first view that is not blended on.
  static double weightOf(double penalty, double threshold) {
    if (!(penalty < threshold)) return 0;
    const double share = std::isinf(threshold) ? 1 : 1 - penalty / threshold;
    return share / std::max(penalty, kLeastPenalty);
  }

  Wanted wantedAt(Vector3 point) const {
    Sighting seen;
    if (!std::isfinite(point.x) || !target_.see(point, seen)) return {};
    return {true, target_.towardEye(point), target_.pixelWidth(seen.range)};
  }

  // The angle between the rays on which view and target see the point, in radians, and how much
  // coarser the view sees it; more toward the view's frame, infinite outside. Multiplied, not added
  // as in the paper, so that a view of the very same ray is perfect up to its frame. Infinite, too,
  // where it is more than `enough`, which most views are told by the angle's cosine.
  double penaltyOf(const ViewProjector& view, Vector3 point, const Wanted& wanted,
                   double enough) const {
    if (!wanted.isSeen) return kNothing;
    const Vector3 toView = view.towardEye(point);
    const double cosine = dot(toView, wanted.toTarget);
    // cos(a) >= 1 - a^2 / 2; a little less, for rounding.
    if (cosine < 1 - 0.5 * enough * enough - 1e-12) return kNothing;
    Sighting seen;
    if (!view.see(point, seen)) return kNothing;
    const double fade = frameFade(view, seen);
    if (fade == 0) return kNothing;
    const double angle = std::atan2(length(cross(toView, wanted.toTarget)), cosine);
    const double coarser = view.pixelWidth(seen.range) / wanted.pixelWidth - 1;
    return (angle + kResolutionShare * angle * std::max(0.0, coarser)) / fade;
  }

  void rankViews(int y) {
    const auto points = points_.row(y);
    LeastPenalties least(rings_[index(Ring::Wide)].count + 1);
    for (int x = 0; x < points_.size.width; ++x) {
      const Vector3 point = points[static_cast<std::size_t>(x)];
      const Wanted wanted = wantedAt(point);
      least.clear();
      for (std::size_t view = 0; view < views_.size(); ++view)
        least.add(penaltyOf(*views_[view], point, wanted, least.last()), view);
      for (RingViews& ring : rings_) {
        ring.thresholds.at(x, y, 0) = least.penalty(ring.count);
        for (std::size_t i = 0; i < std::min(ring.count, least.size()); ++i)
          ring.asked[rowOf(y) + least.view(i)] = 1;
      }
    }
  }

  const ViewProjector& target_;
  std::vector<const ViewProjector*> views_;
  SurfacePoints points_;
  std::array<RingViews, 2> rings_;
};

}  // namespace

std::unique_ptr<BlendRule> freeBlend(const ViewProjector& target,
                                     std::span<const ViewProjector* const> views,
                                     const SurfacePoints& points, int blendedViews) {
  return std::make_unique<FreeBlend>(target, views, points, blendedViews);
}

}  // namespace illum
