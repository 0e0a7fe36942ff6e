// Where the pixels of a turned or mirrored photograph lie in its file (Exif 2.32, tag 0x0112).
#pragma once

#include <cstddef>

#include "illum/picture.h"

namespace illum {

/// Exif's number: 1 upright; 2 mirrored; 3 turned by 180 degrees; 4 mirrored top to bottom; 5 to 8
/// with rows and columns exchanged. Stored positions are an affine function of upright ones:
///   storedX = x0 + xx * x + xy * y,   storedY = y0 + yx * x + yy * y.
struct Orientation {
  int exif = 1;  ///< 1 to 8

  bool exchangesAxes() const { return exif >= 5; }
  /// Whether rows are stored from top to bottom, so that bands can be read in order.
  bool keepsRowOrder() const { return exif <= 2; }
  Size upright(Size stored) const;

  struct Map {
    int x0 = 0, xx = 1, xy = 0;
    int y0 = 0, yx = 0, yy = 1;
  };
  Map storedFromUpright(Size stored) const;

  struct Position {
    int x = 0, y = 0;
    friend bool operator==(const Position&, const Position&) = default;
  };
  Position uprightFromStored(Size stored, Position position) const;
};

}  // namespace illum
