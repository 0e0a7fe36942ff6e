// What an object looks like, for file managers and web pages.
#pragma once

#include <span>

#include "build/plane_row.h"
#include "fit/fit.h"
#include "illum/light.h"
#include "object/manifest.h"

namespace illum {

/// A view's coarsest level under the captured light nearest to its upper left, scaled down by a
/// whole factor to at most kPosterSide a side; black where the mask hides. `lights` are those of
/// the fit, in the view's frame.
BytePicture posterOf(const PlaneRow& coarsest, const Fit& fit, Response response,
                     std::span<const DirectionalLight> lights);

inline constexpr int kPosterSide = 384;

}  // namespace illum
