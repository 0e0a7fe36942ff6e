// The planes of a view point that an object does not have.
#pragma once

#include <cstdint>
#include <vector>

#include "build/plane_row.h"
#include "convert/memory_plan.h"
#include "core/stoppable_progress.h"
#include "illum/lumigraph.h"
#include "illum/object.h"
#include "lumigraph/object_views.h"

namespace illum {

/// All planes of a view, as PlaneRow has those of a row of tiles.
struct NewView {
  Size size;
  std::vector<float> values, coverage, depth;  ///< depth: empty without
  std::uint64_t unseenPixels = 0;              ///< nobody saw them

  /// Row of tiles `row` of level 0, with coverage only if the manifest has a mask.
  PlaneRow tileRow(const Manifest& manifest, int group, int row) const;
};

/// Makes views of the views of one slab, each a picture of some of its planes and its coverage,
/// decoded when it is asked for. Planes are values of the basis' functions, premultiplied by
/// coverage.
class NewViewMaker {
 public:
  /// `progress` must outlive it; it is asked whether to stop.
  NewViewMaker(const Object& object, std::vector<int> groups, const ConversionMemory& memory,
               const StoppableProgress& progress);

  const std::vector<int>& groups() const { return groups_; }
  NewView make(const ViewGeometry& target, const SynthesisOptions& options);

 private:
  void takePlanes(int first);
  void addPart(const SynthesisedView& seen, int first, NewView& view) const;

  Object object_;
  const StoppableProgress& progress_;
  std::vector<int> groups_;
  int planes_, planesAtOnce_, tilesDecoded_;
  int first_ = -1;  ///< of the planes that views_ shows
  ObjectViews views_;
};

}  // namespace illum
