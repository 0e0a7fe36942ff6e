#include "lumigraph/view_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace illum {
namespace {

// A surface at a point's range within the first is the point's, beyond the second it is another
// one; in widths of a pixel, because that is how exactly a depth picture knows steep surfaces.
constexpr double kSameSurface = 2, kOtherSurface = 6;
// Where depths are known less exactly than that, what a view shows is still right if it is no
// farther from where it belongs in the target: in the target's pixels.
constexpr double kSamePlaceSeen = 0.5, kOtherPlaceSeen = 1.5;
// Of the shorter side: how wide views fade at their frames.
constexpr double kFrameShare = 0.05;

// 1 up to `same`, 0 from `other` on.
float falling(double apart, double same, double other) {
  return static_cast<float>(std::clamp((other - apart) / (other - same), 0.0, 1.0));
}

}  // namespace

double frameFade(const ViewProjector& view, const Sighting& seen) {
  const Size size = view.size();
  double inside = std::min(seen.y, size.height - seen.y);
  if (!view.wraps()) inside = std::min({inside, seen.x, size.width - seen.x});
  // Not "inside < 0": what is not a number is not in the frame.
  if (!(inside >= 0)) return 0;
  const double ramp = std::max(1.0, kFrameShare * std::min(size.width, size.height));
  return std::clamp(inside / ramp, 1e-6, 1.0);
}

struct ViewSamples::Taps {
  std::array<int, 4> x, y;
  std::array<float, 4> weight;
};

ViewSamples::ViewSamples(const ViewProjector& target, const ViewProjector& view,
                         const Picture& picture, const Picture* depth, Undefined undefined)
    : target_(target), view_(view), picture_(picture), depth_(depth), undefined_(undefined) {}

ViewSamples::Taps ViewSamples::tapsAt(const Sighting& seen) const {
  const Size size = view_.size();
  const double x = seen.x - 0.5, y = seen.y - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const auto column = [&](int i) {
    return view_.wraps() ? (i + size.width) % size.width : std::clamp(i, 0, size.width - 1);
  };
  const int x0 = column(static_cast<int>(left)), x1 = column(static_cast<int>(left) + 1);
  const int y0 = std::clamp(static_cast<int>(top), 0, size.height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, size.height - 1);
  return {{x0, x1, x0, x1},
          {y0, y0, y1, y1},
          {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

// Leaves the weights of those taps that tell of the point; returns how much that is.
float ViewSamples::weighByDepth(Taps& taps, Vector3 point, const Sighting& seen) const {
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double found = view_.rangeOf(depth_->at(taps.x[i], taps.y[i], 0));
    if (found == kNothing) {
      if (undefined_ == Undefined::Unrelated) taps.weight[i] = 0;
    } else {
      taps.weight[i] *= undefined_ == Undefined::Backdrop ? 0 : agreement(point, seen, found);
    }
    sum += taps.weight[i];
  }
  return sum;
}

// Whether the surface that the view found along the way to the point is the point's.
float ViewSamples::agreement(Vector3 point, const Sighting& seen, double found) const {
  const double apart = std::abs(seen.range - found) / view_.pixelWidth(seen.range);
  if (apart <= kSameSurface) return 1;
  float agrees = falling(apart, kSameSurface, kOtherSurface);
  Sighting wanted, shown;
  if (target_.see(point, wanted) && target_.see(view_.pointAt(seen.x, seen.y, found), shown)) {
    const double shift = std::hypot(shown.x - wanted.x, shown.y - wanted.y);
    agrees = std::max(agrees, falling(shift, kSamePlaceSeen, kOtherPlaceSeen));
  }
  return agrees;
}

void ViewSamples::add(std::span<const Vector3> points, std::span<const float> weights,
                      std::span<float> sums) const {
  const int channels = picture_.channels();
  const auto stride = static_cast<std::size_t>(channels + kExtraSums);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Sighting seen;
    if (!(weights[i] > 0) || !view_.see(points[i], seen)) continue;
    const auto weight = weights[i] * static_cast<float>(frameFade(view_, seen));
    if (!(weight > 0)) continue;
    Taps taps = tapsAt(seen);
    const float visible = depth_ == nullptr ? 1.0F : weighByDepth(taps, points[i], seen);
    float* sum = sums.data() + i * stride;
    sum[channels + kWeightSum] += weight;
    sum[channels + kVisibleSum] += weight * visible;
    if (!(visible > 0)) continue;
    // The taps' weights add up to `visible`: the mean of those that agree, times visible.
    for (std::size_t t = 0; t < 4; ++t) {
      const float share = weight * taps.weight[t];
      if (share == 0) continue;
      const float* texel = &picture_.at(taps.x[t], taps.y[t], 0);
      for (int c = 0; c < channels; ++c) sum[c] += share * texel[c];
    }
  }
}

}  // namespace illum
