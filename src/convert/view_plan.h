// Which views a converted object has, and where each comes from.
#pragma once

#include <optional>
#include <vector>

#include "illum/camera.h"
#include "object/manifest.h"

namespace illum {

struct PlannedView {
  GroupEntry entry;
  std::optional<int> stored;  ///< the group of the old object that it is
  std::vector<int> sources;   ///< else: the groups of its slab
};

/// The views as they are.
std::vector<PlannedView> viewsAsTheyAre(const Manifest& manifest);

/// Every slab with another grid over the same rectangle of view points, row by row from the bottom.
/// A view point that both grids have is the stored one. Throws Error (Fault::Input) for objects
/// with views that are no slab's.
std::vector<PlannedView> viewsOnGrid(const Manifest& manifest, int uCount, int vCount);

}  // namespace illum
