// The planes of a view point that an object does not have.
#pragma once

#include <cstdint>
#include <vector>

#include "build/plane_row.h"
#include "convert/view_plan.h"
#include "illum/lumigraph.h"
#include "illum/object.h"
#include "lumigraph/object_views.h"

namespace illum {

/// The views of one slab, each as a picture of its planes and its coverage, decoded when they are
/// asked for; the latest used are kept within `memoryBytes`. Planes are values of the basis'
/// functions, premultiplied by coverage.
ObjectViews planeViews(const Object& object, const std::vector<int>& groups,
                       std::uint64_t memoryBytes);

/// All planes of a view, as PlaneRow has those of a row of tiles.
struct NewView {
  Size size;
  std::vector<float> values, coverage, depth;  ///< depth: empty without
  std::uint64_t unseenPixels = 0;              ///< nobody saw them

  /// Row of tiles `row` of level 0, with coverage only if the manifest has a mask.
  PlaneRow tileRow(const Manifest& manifest, int group, int row) const;
};

NewView synthesisedPlanes(ObjectViews& views, const ViewGeometry& target,
                          const SynthesisOptions& options);

}  // namespace illum
