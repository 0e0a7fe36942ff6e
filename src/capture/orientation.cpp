#include "capture/orientation.h"

namespace illum {

Size Orientation::upright(Size stored) const {
  return exchangesAxes() ? Size{stored.height, stored.width} : stored;
}

// Exif says which visual side the stored row 0 and the stored column 0 are. For 6, row 0 is the
// right-hand side and column 0 the top: storedY = right - x, storedX = y; the others alike.
Orientation::Map Orientation::storedFromUpright(Size stored) const {
  const int right = stored.width - 1, bottom = stored.height - 1;
  switch (exif) {
    case 2:
      return {right, -1, 0, 0, 0, 1};
    case 3:
      return {right, -1, 0, bottom, 0, -1};
    case 4:
      return {0, 1, 0, bottom, 0, -1};
    case 5:
      return {0, 0, 1, 0, 1, 0};
    case 6:
      return {0, 0, 1, bottom, -1, 0};
    case 7:
      return {right, 0, -1, bottom, -1, 0};
    case 8:
      return {right, 0, -1, 0, 1, 0};
    default:
      return {};
  }
}

// The linear part is a signed permutation, whose inverse is its transpose.
Orientation::Position Orientation::uprightFromStored(Size stored, Position position) const {
  const Map map = storedFromUpright(stored);
  const int dx = position.x - map.x0, dy = position.y - map.y0;
  return {map.xx * dx + map.yx * dy, map.xy * dx + map.yy * dy};
}

}  // namespace illum
