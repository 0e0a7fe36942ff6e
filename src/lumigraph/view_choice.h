// Which of an object's views is meant, or which between its views.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "illum/camera.h"

namespace illum {

/// What is to be seen: one of the views, or what has to be synthesised from them.
struct ViewChoice {
  std::optional<int> group;       ///< the view that is exactly this
  ViewGeometry geometry;          ///< of `group`, or a camera
  std::optional<LightSlab> slab;  ///< at or between whose view points that is
};

/// In the middle of the first slab's view points; else the view nearest to the middle of all eyes.
/// At least one view.
ViewChoice middleView(std::span<const View> views);

/// "u,v" of the first slab or "slab:u,v", both in [0, 1] over the grid of view points, fractions
/// between them; or a view's name. Throws Error (Fault::Usage) for what is neither, and for a
/// photograph, which has one view only.
ViewChoice viewNamed(std::span<const View> views, const std::string& name);

}  // namespace illum
