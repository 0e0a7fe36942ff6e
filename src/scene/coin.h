// A struck and worn coin as heights over a square.
#pragma once

#include <string_view>
#include <vector>

#include "illum/vector.h"
#include "scene/scene.h"

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

/// How far (x, y) is from the nearest stroke of `text` (of the letters A G H I L M P R U), written
/// along a circle about the origin: clockwise, letters standing on `radius`, `letterHeight` high,
/// its middle at the top.
double distanceToLetters(std::string_view text, double radius, double letterHeight, double x,
                         double y);

constexpr double kCoinRadius = 0.92;

/// The struck face: rim, beads, letters, a head in profile, scratches. 0 is the table.
HeightMap coinHeights(int side);

}  // namespace illum
