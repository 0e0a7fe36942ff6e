// Hairs as people write them: points that a hair passes from root to tip.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace illum {

/// One hair of at least two points from root to tip, radii from `radius[0]` at the root to
/// `radius[1]`. The spline passes the first and the last point and comes near the others.
void addHair(CurveSet& curves, std::span<const Vector3> points, std::array<double, 2> radius);

/// The text of a hair file: three numbers a line, x y z; a blank line ends a hair; # begins a
/// comment. Throws Error naming `source` and the line. Untrusted input is safe.
std::vector<std::vector<Vector3>> hairsFromText(std::string_view text, const std::string& source);

}  // namespace illum
