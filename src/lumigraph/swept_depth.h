// Where the surfaces are that several pictures show.
#pragma once

#include <span>

#include "lumigraph/small_picture.h"

namespace illum {

/// The longer side of pictures that are swept.
inline constexpr int kSweptSide = 480;
/// Of a view, how many others are compared with it.
inline constexpr std::size_t kSweptNeighbours = 4;

/// For each pixel of a view, that depth at which its neighbours' colours agree best with its own
/// (plane sweep: Collins, "A space-sweep approach to true multi-image matching", 1996), from
/// infinity to where the nearest neighbour's picture is shifted by a quarter of its longer side.
/// Costs are smoothed over squares of pixels that weigh by likeness of colour (Yoon and Kweon
/// 2006), so that depth ends where things do. Only the better half of the neighbours counts,
/// because what one side hides the other shows (Kang, Szeliski and Chai 2001).
///
/// One channel of the size of `picture`, which `view` is the small form of (kSweptSide), linear and
/// of three channels or more; as camera.h's depthOf. At least one neighbour, none of them where the
/// view is. The same on any number of threads.
Picture sweptDepth(const Picture& picture, const SmallView& view,
                   std::span<const SmallView* const> neighbours);

}  // namespace illum
