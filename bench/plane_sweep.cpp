#include "plane_sweep.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "illum/colour.h"

namespace illum::bench {
namespace {

constexpr int kReach = 4;                // of the smoothing square, in pixels
constexpr float kLikeColour = 0.06F;     // of display values
constexpr float kMostDifference = 0.2F;  // beyond this two colours just differ

// What differences are judged by: display values, 3 channels.
Picture displayed(const Picture& picture) {
  Picture shown(picture.size(), 3);
  const auto channels = static_cast<std::size_t>(picture.channels());
  for (std::size_t i = 0; i < picture.size().pixels(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      shown.samples()[3 * i + c] = displayFromLinear(picture.samples()[channels * i + c]);
    }
  }
  return shown;
}

float difference(const float* a, const float* b) {
  const float sum = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
  return std::min(kMostDifference, sum / 3);
}

// Bilinear; false outside.
bool sample(const Picture& picture, PixelPosition at, std::array<float, 3>& colour) {
  const double x = at.x - 0.5, y = at.y - 0.5;
  if (!(x >= 0 && y >= 0 && x <= picture.width() - 1 && y <= picture.height() - 1)) return false;
  const int left = std::min(static_cast<int>(x), picture.width() - 2);
  const int top = std::min(static_cast<int>(y), picture.height() - 2);
  const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const float* upper = &picture.at(left, top, 0);
  const float* lower = &picture.at(left, top + 1, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = (1 - fy) * ((1 - fx) * upper[c] + fx * upper[c + 3]) +
                fy * ((1 - fx) * lower[c] + fx * lower[c + 3]);
  }
  return true;
}

class Sweep {
 public:
  Sweep(const SourceView& view, std::span<const SourceView> neighbours)
      : geometry_(view.view.geometry), own_(displayed(view.picture)) {
    for (const SourceView& neighbour : neighbours) {
      geometries_.push_back(neighbour.view.geometry);
      pictures_.push_back(displayed(neighbour.picture));
    }
  }

  const Picture& own() const { return own_; }

  /// Mean difference of the better half of the neighbours, one channel.
  Picture cost(double depth) const {
    Picture cost(own_.size(), 1);
    tbb::parallel_for(0, own_.height(), [&](int y) {
      std::vector<float> found;
      for (int x = 0; x < own_.width(); ++x) {
        found.clear();
        const Vector3 point = pointAt(geometry_, {x + 0.5, y + 0.5}, depth);
        for (std::size_t n = 0; n < pictures_.size(); ++n) {
          const auto at = pixelOf(geometries_[n], point);
          std::array<float, 3> colour;
          if (at && sample(pictures_[n], *at, colour)) {
            found.push_back(difference(&own_.at(x, y, 0), colour.data()));
          }
        }
        std::sort(found.begin(), found.end());
        const std::size_t better = (found.size() + 1) / 2;
        float sum = 0;
        for (std::size_t i = 0; i < better; ++i) sum += found[i];
        cost.at(x, y, 0) = better > 0 ? sum / static_cast<float>(better) : kMostDifference;
      }
    });
    return cost;
  }

 private:
  ViewGeometry geometry_;
  Picture own_;
  std::vector<ViewGeometry> geometries_;
  std::vector<Picture> pictures_;
};

// One direction of the smoothing; the square is done as a row of columns, which is nearly the same.
Picture smoothed(const Picture& cost, const Picture& guide, int stepX, int stepY) {
  Picture result(cost.size(), 1);
  tbb::parallel_for(0, cost.height(), [&](int y) {
    for (int x = 0; x < cost.width(); ++x) {
      float sum = 0, weights = 0;
      for (int i = -kReach; i <= kReach; ++i) {
        const int px = x + i * stepX, py = y + i * stepY;
        if (px < 0 || py < 0 || px >= cost.width() || py >= cost.height()) continue;
        const float apart = difference(&guide.at(x, y, 0), &guide.at(px, py, 0)) / kLikeColour;
        const float weight = 1 / (1 + apart * apart);
        sum += weight * cost.at(px, py, 0);
        weights += weight;
      }
      result.at(x, y, 0) = sum / weights;
    }
  });
  return result;
}

}  // namespace

std::vector<double> depthsBetween(double nearest, double farthest, int count) {
  std::vector<double> depths;
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 0;
    depths.push_back(1 / ((1 - share) / nearest + share / farthest));
  }
  return depths;
}

Picture sweptDepth(const SourceView& view, std::span<const SourceView> neighbours,
                   std::span<const double> depths) {
  const Sweep sweep(view, neighbours);
  Picture best(sweep.own().size(), 1), depth(best.size(), 1);
  std::ranges::fill(best.samples(), std::numeric_limits<float>::infinity());
  for (const double candidate : depths) {
    Picture cost = smoothed(sweep.cost(candidate), sweep.own(), 1, 0);
    cost = smoothed(cost, sweep.own(), 0, 1);
    for (std::size_t i = 0; i < cost.samples().size(); ++i) {
      if (!(cost.samples()[i] < best.samples()[i])) continue;
      best.samples()[i] = cost.samples()[i];
      depth.samples()[i] = static_cast<float>(candidate);
    }
  }
  return depth;
}

double bestCommonDepth(const SourceView& view, std::span<const SourceView> neighbours,
                       std::span<const double> depths) {
  const Sweep sweep(view, neighbours);
  double best = depths.front(), least = std::numeric_limits<double>::infinity();
  for (const double candidate : depths) {
    const Picture cost = sweep.cost(candidate);
    double sum = 0;
    for (const float value : cost.samples()) sum += static_cast<double>(value) * value;
    if (sum < least) {
      least = sum;
      best = candidate;
    }
  }
  return best;
}

}  // namespace illum::bench
