// The nearest surface along the ray through every pixel's centre.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "lumigraph/view_projector.h"

namespace illum {

/// Where a vertex of a surface falls in the target's picture.
struct ScreenVertex {
  double x = 0, y = 0;
  double value = 0;  ///< what is linear over a plane's picture: 1 / range, or the range
  bool seen = false;
};

/// Keeps the least range of whatever is drawn into each pixel, in any order: drawing from many
/// threads gives the same as drawing from one.
class RangeBuffer {
 public:
  explicit RangeBuffer(const ViewProjector& target);

  const ViewProjector& target() const { return *target_; }
  ScreenVertex vertex(Vector3 point) const;
  /// A triangle whose vertices run clockwise in the target's picture (y down); others turn their
  /// backs and are not drawn.
  void drawTriangle(ScreenVertex a, ScreenVertex b, ScreenVertex c);
  /// The least of all ranges; kNothing if nothing was drawn.
  double nearest() const { return *std::min_element(ranges_.begin(), ranges_.end()); }
  /// kNothing where nothing was drawn.
  double range(int x, int y) const {
    return ranges_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
                   static_cast<std::size_t>(x)];
  }

 private:
  void fillTriangle(const std::array<ScreenVertex, 3>& corners);
  void lower(int x, int y, double range);

  const ViewProjector* target_;
  Size size_;
  std::vector<double> ranges_;
};

}  // namespace illum
