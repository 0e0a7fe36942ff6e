#include "lumigraph/swept_depth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace illum {
namespace {

// From plane to plane, and the nearest one, as shifts between the view and its nearest neighbour.
constexpr double kStep = 0.5, kGreatestShare = 0.25;
constexpr int kReach = 4;             // of the smoothing square, in pixels
constexpr float kLikeColour = 0.06F;  // of display values
// The first look, which only finds between which planes things are: so many pixels apart, over
// squares of so many of them, and what share of all may lie before or behind.
constexpr int kLookEvery = 4, kLookReach = 2;
constexpr double kLookedOver = 0.005;

using Indices = PictureOf<int>;

class Sweep {
 public:
  Sweep(const SmallView& view, std::span<const SmallView* const> neighbours)
      : view_(view), neighbours_(neighbours.begin(), neighbours.end()), own_(colours(view)) {
    double apart = std::numeric_limits<double>::infinity();
    for (const SmallView* neighbour : neighbours_)
      apart = std::min(apart, length(neighbour->projector.eye() - view.projector.eye()));
    // A point at range r shifts by apart / pixelWidth(r) pixels, and pixelWidth goes with r.
    shiftTimesRange_ = apart / view.projector.pixelWidth(1);
    step_ = kStep * view.picture.shrink();
    planes_ = 1 + static_cast<int>(kGreatestShare * std::max(own_.width(), own_.height()) / kStep);
    weighPixels();
  }

  /// Plane 0 stands for all that is so far away that pictures do not tell how far; fractions are
  /// between planes.
  double rangeOf(double plane) const {
    constexpr double kFarthest = 0.25;
    return shiftTimesRange_ / (std::max(plane, kFarthest) * step_);
  }

  /// Of each pixel of the small picture, the plane.
  Picture planes() const {
    const auto [first, last] = occupied();
    Picture best(own_.size(), 1), plane(own_.size(), 1), before, after;
    std::ranges::fill(best.samples(), std::numeric_limits<float>::infinity());
    Indices at(own_.size(), 1);
    Picture previous(own_.size(), 1);
    before = after = previous;
    for (int i = first; i <= last; ++i) {
      const Picture cost = smoothed(costOf(i));
      tbb::parallel_for(0, own_.height(), [&](int y) {
        for (int x = 0; x < own_.width(); ++x) {
          const float value = cost.at(x, y, 0);
          if (i > first && at.at(x, y, 0) == i - 1) after.at(x, y, 0) = value;
          if (value < best.at(x, y, 0)) {
            best.at(x, y, 0) = value;
            before.at(x, y, 0) = i > first ? previous.at(x, y, 0) : value;
            after.at(x, y, 0) = value;
            at.at(x, y, 0) = i;
          }
        }
      });
      previous = cost;
    }
    for (std::size_t p = 0; p < plane.samples().size(); ++p) {
      const float low = before.samples()[p], least = best.samples()[p], high = after.samples()[p];
      // Where the parabola through the least cost and its two neighbours has its vertex.
      const float bend = low - 2 * least + high;
      const float aside = bend > 0 ? std::clamp(0.5F * (low - high) / bend, -0.5F, 0.5F) : 0;
      // Finer than is known, and each step costs bytes.
      constexpr float kParts = 2;
      plane.samples()[p] = std::max(
          0.0F, std::round(kParts * (static_cast<float>(at.samples()[p]) + aside)) / kParts);
    }
    return plane;
  }

 private:
  static const Picture& colours(const SmallView& view) { return view.picture.colours(); }

  // Mean difference of the better half of the neighbours at a pixel.
  float costAt(int x, int y, double range) const {
    const PixelPosition from = view_.picture.middleOf(x, y);
    const Vector3 point = view_.projector.pointAt(from.x, from.y, range);
    std::array<float, kSweptNeighbours> found;
    std::size_t count = 0;
    for (const SmallView* neighbour : neighbours_) {
      Sighting at;
      std::array<float, 3> colour;
      if (count == found.size() || !neighbour->projector.see(point, at) ||
          !neighbour->picture.sample(at, colour))
        continue;
      // Ascending.
      const float apart = differenceOf(&own_.at(x, y, 0), colour.data());
      std::size_t place = count++;
      for (; place > 0 && found[place - 1] > apart; --place) found[place] = found[place - 1];
      found[place] = apart;
    }
    if (count == 0) return kMostDifference;
    const std::size_t better = (count + 1) / 2;
    float sum = 0;
    for (std::size_t i = 0; i < better; ++i) sum += found[i];
    return sum / static_cast<float>(better);
  }

  Picture costOf(int plane) const {
    const double range = rangeOf(plane);
    Picture cost(own_.size(), 1);
    tbb::parallel_for(0, own_.height(), [&](int y) {
      for (int x = 0; x < own_.width(); ++x) cost.at(x, y, 0) = costAt(x, y, range);
    });
    return cost;
  }

  // The first and last plane with anything on it.
  std::pair<int, int> occupied() const {
    const Size size{(own_.width() + kLookEvery - 1) / kLookEvery,
                    (own_.height() + kLookEvery - 1) / kLookEvery};
    PictureOf<float> costs(size, planes_);
    tbb::parallel_for(0, size.height, [&](int y) {
      for (int x = 0; x < size.width; ++x) {
        for (int i = 0; i < planes_; ++i)
          costs.at(x, y, i) = costAt(x * kLookEvery, y * kLookEvery, rangeOf(i));
      }
    });
    std::vector<std::size_t> on(static_cast<std::size_t>(planes_));
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) ++on[static_cast<std::size_t>(leastAround(costs, x, y))];
    }
    const double few = kLookedOver * static_cast<double>(size.pixels());
    const auto firstOf = [&](auto begin, auto end) {
      double passed = 0;
      int at = 0;
      for (; begin != end && passed + static_cast<double>(*begin) <= few; ++begin, ++at)
        passed += static_cast<double>(*begin);
      return std::min(at, planes_ - 1);
    };
    constexpr int kMargin = 2;
    const int first = firstOf(on.begin(), on.end());
    const int last = planes_ - 1 - firstOf(on.rbegin(), on.rend());
    return {std::max(0, first - kMargin), std::min(planes_ - 1, std::max(first, last) + kMargin)};
  }

  int leastAround(const PictureOf<float>& costs, int x, int y) const {
    std::vector<float> sums(static_cast<std::size_t>(planes_));
    for (int dy = -kLookReach; dy <= kLookReach; ++dy) {
      for (int dx = -kLookReach; dx <= kLookReach; ++dx) {
        const int px = std::clamp(x + dx, 0, costs.width() - 1);
        const int py = std::clamp(y + dy, 0, costs.height() - 1);
        const float* from = &costs.at(px, py, 0);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += from[i];
      }
    }
    return static_cast<int>(std::ranges::min_element(sums) - sums.begin());
  }

  // The weights of a pixel's neighbours along its row and along its column; outside: 0.
  void weighPixels() {
    constexpr int kAlong = 2 * kReach + 1;
    for (Picture* weights : {&across_, &down_}) *weights = Picture(own_.size(), kAlong);
    tbb::parallel_for(0, own_.height(), [&](int y) {
      for (int x = 0; x < own_.width(); ++x) {
        for (const bool across : {true, false}) {
          float* weights = &(across ? across_ : down_).at(x, y, 0);
          float sum = 0;
          for (int i = -kReach; i <= kReach; ++i) {
            const int px = x + (across ? i : 0), py = y + (across ? 0 : i);
            if (px < 0 || py < 0 || px >= own_.width() || py >= own_.height()) continue;
            const float apart = differenceOf(&own_.at(x, y, 0), &own_.at(px, py, 0)) / kLikeColour;
            weights[i + kReach] = 1 / (1 + apart * apart);
            sum += weights[i + kReach];
          }
          for (int i = 0; i < kAlong; ++i) weights[i] /= sum;
        }
      }
    });
  }

  // The square is done as a row of columns, which is nearly the same.
  Picture smoothed(const Picture& cost) const {
    return smoothedAlong(smoothedAlong(cost, across_, 1, 0), down_, 0, 1);
  }
  static Picture smoothedAlong(const Picture& cost, const Picture& weights, int stepX, int stepY) {
    Picture result(cost.size(), 1);
    tbb::parallel_for(0, cost.height(), [&](int y) {
      for (int x = 0; x < cost.width(); ++x) {
        const float* weight = &weights.at(x, y, 0);
        float sum = 0;
        for (int i = -kReach; i <= kReach; ++i, ++weight) {
          if (*weight > 0) sum += *weight * cost.at(x + i * stepX, y + i * stepY, 0);
        }
        result.at(x, y, 0) = sum;
      }
    });
    return result;
  }

  const SmallView& view_;
  std::vector<const SmallView*> neighbours_;
  const Picture& own_;
  double shiftTimesRange_ = 1, step_ = 1;
  int planes_ = 1;
  Picture across_, down_;
};

// Takes out what none of the pixels around a pixel agree with.
Picture medianOf(const Picture& planes) {
  Picture result(planes.size(), 1);
  tbb::parallel_for(0, planes.height(), [&](int y) {
    for (int x = 0; x < planes.width(); ++x) {
      std::array<float, 9> around;
      for (int i = 0; i < 9; ++i) {
        around[static_cast<std::size_t>(i)] =
            planes.at(std::clamp(x + i % 3 - 1, 0, planes.width() - 1),
                      std::clamp(y + i / 3 - 1, 0, planes.height() - 1), 0);
      }
      std::ranges::nth_element(around, around.begin() + 4);
      result.at(x, y, 0) = around[4];
    }
  });
  return result;
}

}  // namespace

Picture sweptDepth(const Picture& picture, const SmallView& view,
                   std::span<const SmallView* const> neighbours) {
  const Sweep sweep(view, neighbours);
  const Picture planes = medianOf(sweep.planes());
  const Picture& colours = view.picture.colours();
  const int shrink = view.picture.shrink();
  Picture depth(picture.size(), 1);
  // Of the four small pixels around a pixel, the one whose colour is most like its own.
  const SmallPicture full(picture, std::max(picture.width(), picture.height()));
  tbb::parallel_for(0, depth.height(), [&](int y) {
    for (int x = 0; x < depth.width(); ++x) {
      const int left = static_cast<int>(std::floor((x + 0.5) / shrink - 0.5));
      const int top = static_cast<int>(std::floor((y + 0.5) / shrink - 0.5));
      float plane = 0, least = std::numeric_limits<float>::infinity();
      for (int i = 0; i < 4; ++i) {
        const int px = std::clamp(left + i % 2, 0, planes.width() - 1);
        const int py = std::clamp(top + i / 2, 0, planes.height() - 1);
        const float apart = differenceOf(&full.colours().at(x, y, 0), &colours.at(px, py, 0));
        if (!(apart < least)) continue;
        least = apart;
        plane = planes.at(px, py, 0);
      }
      depth.at(x, y, 0) =
          static_cast<float>(view.projector.depthOf(sweep.rangeOf(static_cast<double>(plane))));
    }
  });
  return depth;
}

}  // namespace illum
