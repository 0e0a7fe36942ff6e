#include "lumigraph/range_buffer.h"

#include <algorithm>

namespace illum {
namespace {

// Twice the signed area; positive for clockwise triangles with y down.
double cross2(const ScreenVertex& a, const ScreenVertex& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

RangeBuffer::RangeBuffer(const ViewProjector& target)
    : target_(&target), size_(target.size()), ranges_(size_.pixels(), kNothing) {}

ScreenVertex RangeBuffer::vertex(Vector3 point) const {
  Sighting seen;
  ScreenVertex vertex;
  vertex.seen = target_->see(point, seen) && std::isfinite(seen.range);
  vertex.x = seen.x;
  vertex.y = seen.y;
  vertex.value = target_->isPerspective() ? 1 / seen.range : seen.range;
  return vertex;
}

void RangeBuffer::drawTriangle(ScreenVertex a, ScreenVertex b, ScreenVertex c) {
  if (!a.seen || !b.seen || !c.seen) return;
  std::array<ScreenVertex, 3> corners{a, b, c};
  if (!target_->wraps()) return fillTriangle(corners);
  // A triangle across the seam of a panorama is drawn on both sides of it.
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  if (right - left < 0.5 * size_.width) return fillTriangle(corners);
  for (ScreenVertex& v : corners) {
    if (v.x < 0.5 * size_.width) v.x += size_.width;
  }
  fillTriangle(corners);
  for (ScreenVertex& v : corners) v.x -= size_.width;
  fillTriangle(corners);
}

void RangeBuffer::fillTriangle(const std::array<ScreenVertex, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double area = cross2(a, b, c.x, c.y);
  // Not "area <= 0": what is not a number is not drawn either.
  if (!(area > 1e-12)) return;
  // Edges belong to both of their triangles; a tolerance, or centres on them would fall between.
  const double slack = -1e-7 * (1 + area);
  const auto first = [](double low) { return static_cast<int>(std::ceil(low - 0.5 - 1e-6)); };
  const auto last = [](double high) { return static_cast<int>(std::floor(high - 0.5 + 1e-6)); };
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  if (right < 0 || bottom < 0 || left > size_.width || top > size_.height) return;
  const int x0 = first(std::max(left, 0.0)), x1 = last(std::min<double>(right, size_.width));
  const int y0 = first(std::max(top, 0.0)), y1 = last(std::min<double>(bottom, size_.height));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double wa = cross2(b, c, px, py), wb = cross2(c, a, px, py), wc = area - wa - wb;
      if (wa < slack || wb < slack || wc < slack) continue;
      const double value = (wa * a.value + wb * b.value + wc * c.value) / area;
      lower(x, y, target_->isPerspective() ? 1 / value : value);
    }
  }
}

void RangeBuffer::lower(int x, int y, double range) {
  std::atomic_ref<double> nearest(
      ranges_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
              static_cast<std::size_t>(x)]);
  double found = nearest.load(std::memory_order_relaxed);
  while (range > 0 && range < found &&
         !nearest.compare_exchange_weak(found, range, std::memory_order_relaxed)) {
  }
}

}  // namespace illum
