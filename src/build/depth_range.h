// How finely the depths of a view are kept (docs/format.md, "Mask, depth and poster").
#pragma once

#include <vector>

#include "illum/camera.h"
#include "illum/capture.h"
#include "object/manifest.h"

namespace illum {

/// How far a point may move, in pixels, when its rounded depth carries it into the next view.
inline constexpr double kDepthErrorPixels = 0.1;

/// Steps so fine that a point of view `group` whose depth lies in [from, to] moves by at most
/// kDepthErrorPixels when it is carried into the next view. The next view of a slab is its
/// neighbour on the grid; of a camera or a panorama the nearest other one; of a single view one
/// that is turned by a tenth of a radian about the point.
DepthRange depthRangeFor(const std::vector<View>& views, int group, double from, double to);

/// The same for the depths that the view has, which are read once from top to bottom, in parallel.
DepthRange depthRangeOf(const Capture& capture, int group);

}  // namespace illum
