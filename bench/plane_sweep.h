// Depth of a view from the pictures of its neighbours.
#pragma once

#include <span>
#include <vector>

#include "illum/lumigraph.h"

namespace illum::bench {

/// For each pixel of `view`, that one of `depths` at which the neighbours' colours agree best with
/// its own (plane sweep: Collins 1996), smoothed over a square of pixels that weigh by likeness of
/// colour (Yoon and Kweon 2006) so that depth ends where objects do. Of each side of the view only
/// the better half of the neighbours counts, because what one side hides the other shows (Kang,
/// Szeliski, Chai 2001). One channel, as ViewSource::depth.
Picture sweptDepth(const SourceView& view, std::span<const SourceView> neighbours,
                   std::span<const double> depths);

/// `count` depths from `nearest` to `farthest`, evenly in 1 / depth, which is evenly in pixels.
std::vector<double> depthsBetween(double nearest, double farthest, int count);

/// That one of `depths` at which the neighbours' colours, all pixels taken together, agree best
/// with the view's: where a common focal plane should stand. By squared differences.
double bestCommonDepth(const SourceView& view, std::span<const SourceView> neighbours,
                       std::span<const double> depths);

}  // namespace illum::bench
