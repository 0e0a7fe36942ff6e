// Heights over a square, for reliefs.
#pragma once

#include <vector>

namespace illum {

/// Values over [-1, 1]^2, row 0 at y = -1, between which others are interpolated.
class HeightMap {
 public:
  explicit HeightMap(int side);

  int side() const { return side_; }
  double spacing() const { return 2.0 / (side_ - 1); }
  float& at(int column, int row);
  float at(int column, int row) const;
  double coordinate(int index) const { return -1 + index * spacing(); }
  /// Bilinear; the edge continues outside.
  double value(double x, double y) const;
  /// Means over squares of 2 * `reach` + 1 samples a side, twice: nearly a bell.
  HeightMap blurred(int reach) const;

 private:
  HeightMap blurredOnce(int reach) const;

  int side_;
  std::vector<float> values_;
};

/// Smooth noise in [-1, 1] whose bumps are about 1 / `frequency` wide.
double valueNoise(double x, double y, double frequency, unsigned seed);

}  // namespace illum
