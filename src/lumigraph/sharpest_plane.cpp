#include "lumigraph/sharpest_plane.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lumigraph/small_picture.h"

namespace illum {
namespace {

constexpr std::size_t kNeighbours = 8;
// Of the pictures that are compared, in pixels; finer ones would only compare noise.
constexpr int kLongerSide = 320;
// From plane to plane, and the nearest one, as shifts between the middle picture and that of its
// nearest neighbour.
constexpr double kStep = 0.5, kGreatestShare = 0.25;

// Mean squared difference to the middle one; infinite where they hardly overlap.
double disagreement(const SmallView& middle, const std::vector<SmallView>& others, double range) {
  const Picture& own = middle.picture.colours();
  const Size size = own.size();
  std::vector<double> sums(static_cast<std::size_t>(size.height)), counts(sums.size());
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      const PixelPosition from = middle.picture.middleOf(x, y);
      const Vector3 point = middle.projector.pointAt(from.x, from.y, range);
      for (const SmallView& other : others) {
        Sighting at;
        std::array<float, 3> colour{};
        if (!other.projector.see(point, at) || !other.picture.sample(at, colour)) continue;
        const float apart = differenceOf(colour.data(), &own.at(x, y, 0));
        sums[static_cast<std::size_t>(y)] += static_cast<double>(apart * apart);
        counts[static_cast<std::size_t>(y)] += 1;
      }
    }
  });
  double sum = 0, count = 0;
  for (std::size_t y = 0; y < sums.size(); ++y) {
    sum += sums[y];
    count += counts[y];
  }
  const double all = static_cast<double>(size.pixels() * others.size());
  return count >= all / 4 ? sum / count : std::numeric_limits<double>::infinity();
}

// The view nearest to the mean of all eyes, then the nearest ones to it at other places.
std::vector<int> middleAndNeighbours(const std::vector<View>& views) {
  std::vector<Vector3> eyes;
  Vector3 mean;
  for (const View& view : views) {
    eyes.push_back(ViewProjector(view.geometry).eye());
    mean = mean + (1 / static_cast<double>(views.size())) * eyes.back();
  }
  std::vector<int> order(views.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const auto byDistance = [&](Vector3 from) {
    std::ranges::stable_sort(
        order, {}, [&](int i) { return length(eyes[static_cast<std::size_t>(i)] - from); });
  };
  byDistance(mean);
  const Vector3 middle = eyes[static_cast<std::size_t>(order.front())];
  const int first = order.front();
  byDistance(middle);
  std::erase_if(order,
                [&](int i) { return !(length(eyes[static_cast<std::size_t>(i)] - middle) > 0); });
  order.resize(std::min(order.size(), kNeighbours));
  order.insert(order.begin(), first);
  return order;
}

// Where the parabola through the least value and its two neighbours has its vertex.
double lowestNear(const std::vector<double>& values, std::size_t least) {
  const auto at = static_cast<double>(least);
  if (least == 0 || least + 1 >= values.size()) return at;
  const double before = values[least - 1], after = values[least + 1];
  const double bend = before - 2 * values[least] + after;
  return bend > 0 && std::isfinite(bend) ? at + 0.5 * (before - after) / bend : at;
}

}  // namespace

std::optional<Plane> sharpestPlane(ViewSource& source) {
  const std::vector<View>& views = source.views();
  const bool free = std::ranges::all_of(
      views, [](const View& view) { return std::holds_alternative<PinholeCamera>(view.geometry); });
  if (!free || views.empty()) return std::nullopt;
  std::vector<SmallView> seen;
  for (const int view : middleAndNeighbours(views)) {
    const auto picture = source.picture(view);
    seen.push_back({ViewProjector(views[static_cast<std::size_t>(view)].geometry),
                    SmallPicture(*picture, kLongerSide)});
  }
  if (seen.size() < 2) return std::nullopt;
  const SmallView middle = std::move(seen.front());
  seen.erase(seen.begin());
  const double apart = length(seen.front().projector.eye() - middle.projector.eye());
  const Size size = middle.projector.size();
  const double shrink = middle.picture.shrink();
  // A point at range r shifts by apart / pixelWidth(r) pixels, and pixelWidth goes with r.
  const double shiftTimesRange = apart / middle.projector.pixelWidth(1);
  const double step = kStep * shrink;
  std::vector<double> found{disagreement(middle, seen, 1e6 * shiftTimesRange)};  // of shift 0
  for (int i = 1; i * step <= kGreatestShare * std::max(size.width, size.height); ++i)
    found.push_back(disagreement(middle, seen, shiftTimesRange / (i * step)));
  const auto best = static_cast<std::size_t>(std::ranges::min_element(found) - found.begin());
  if (best == 0) return std::nullopt;
  const double shift = step * lowestNear(found, best);
  const Vector3 axis = middle.projector.axis();
  return Plane{middle.projector.eye() + (shiftTimesRange / shift) * axis, axis};
}

}  // namespace illum
