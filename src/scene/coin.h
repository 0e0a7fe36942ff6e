// A struck and worn coin as heights over a square.
#pragma once

#include <string_view>

#include "scene/height_map.h"

namespace illum {

/// How far (x, y) is from the nearest stroke of `text` (of the letters A G H I L M P R U), written
/// along a circle about the origin: clockwise, letters standing on `radius`, `letterHeight` high,
/// its middle at the top.
double distanceToLetters(std::string_view text, double radius, double letterHeight, double x,
                         double y);

constexpr double kCoinRadius = 0.92;

/// The struck face: rim, beads, letters, a head in profile, scratches. 0 is the table.
HeightMap coinHeights(int side);

}  // namespace illum
