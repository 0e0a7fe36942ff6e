// The depth picture of a view as a surface: pixels' points joined where the surface goes on, cut
// where it jumps.
#pragma once

#include "illum/picture.h"
#include "lumigraph/range_buffer.h"
#include "lumigraph/view_projector.h"

namespace illum {

/// Whether a surface goes on from a pixel of range `a` to its neighbour of range `b`: if the step
/// is no steeper than `steepest` (in units of range), or no steeper than twice its continuation on
/// both sides, `before` a and `after` b, which makes it a steep surface and not an edge. kNothing
/// joins nothing.
bool isJoined(double before, double a, double b, double after, double steepest);

/// Draws what `view` saw into `buffer`. Pixels beside a cut stand as small squares, so that what is
/// one pixel wide is not lost; toward nothing they reach one pixel out, where coverage fades.
/// `coverage`, if there is one: a picture whose last channel it is; then only pixels that are
/// covered wholly are drawn, and none reaches out.
void drawDepth(const ViewProjector& view, const Picture& depth, const Picture* coverage,
               RangeBuffer& buffer);

}  // namespace illum
