// Where cameras that all look the same way should be focused.
#pragma once

#include <optional>

#include "illum/lumigraph.h"

namespace illum {

/// The plane square to the middle camera's axis on which its picture and those of the cameras about
/// it agree best (plane sweep: Collins, "A space-sweep approach to true multi-image matching",
/// 1996). Empty where that is infinity, and for views that are not at least two pinhole cameras at
/// different places.
std::optional<Plane> sharpestPlane(ViewSource& source);

}  // namespace illum
