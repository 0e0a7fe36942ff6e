// Pictures of different views made small and put into display values, to be compared.
#pragma once

#include <array>

#include "illum/picture.h"
#include "lumigraph/view_projector.h"

namespace illum {

/// Display values of a linear picture's first three channels, box-filtered by a whole factor.
class SmallPicture {
 public:
  /// By so much that the longer side is at most `longerSide`.
  SmallPicture(const Picture& picture, int longerSide);

  int shrink() const { return shrink_; }
  const Picture& colours() const { return colours_; }
  /// Of the middle of a pixel of the small picture, in pixels of the large one.
  PixelPosition middleOf(int x, int y) const { return {(x + 0.5) * shrink_, (y + 0.5) * shrink_}; }

  /// Bilinear at a position of the large picture; false outside.
  bool sample(const Sighting& at, std::array<float, 3>& colour) const {
    const double x = at.x / shrink_ - 0.5, y = at.y / shrink_ - 0.5;
    if (!(x >= 0 && y >= 0 && x < colours_.width() - 1 && y < colours_.height() - 1)) return false;
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
    const float* upper = &colours_.at(left, top, 0);
    const float* lower = &colours_.at(left, top + 1, 0);
    for (std::size_t c = 0; c < 3; ++c) {
      colour[c] = (1 - fy) * ((1 - fx) * upper[c] + fx * upper[c + 3]) +
                  fy * ((1 - fx) * lower[c] + fx * lower[c + 3]);
    }
    return true;
  }

 private:
  int shrink_;
  Picture colours_;
};

/// A view and its picture.
struct SmallView {
  ViewProjector projector;
  SmallPicture picture;
};

/// Mean difference of three display values; two that differ by more just differ, for what is hidden
/// in one picture is no worse than that.
inline constexpr float kMostDifference = 0.2F;
inline float differenceOf(const float* a, const float* b) {
  const float sum = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
  return std::min(kMostDifference, sum / 3);
}

}  // namespace illum
