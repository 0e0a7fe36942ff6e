// Where the pixels of a view lie, for lights near the object.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "illum/camera.h"
#include "illum/object.h"

namespace illum {

/// The same of one tile.
class SurfaceTile {
 public:
  SurfaceTile() = default;

  /// The points, in the group's frame, of pixels (left, row), (left + 1, row), ... of the tile; not
  /// numbers where nothing is seen.
  void points(int left, int row, std::span<Vector3> out) const;

 private:
  friend class Surface;
  ViewGeometry view_;         // in its group's frame
  Rectangle tile_;            // within its level
  int scale_ = 1;             // of the level: a pixel is so many of level 0
  std::vector<float> depth_;  // of the tile, row by row; empty: 0
};

/// A view's own depth, or for photographs without: heights that were given for them, or the plane
/// z = 0. Views of a slab without depth lie in its window.
class Surface {
 public:
  Surface() = default;
  /// `heights`: z of the pixels of level 0 in channel 0; may be empty. Throws Error (Fault::Input)
  /// for heights of another size or not finite, and for views of whose pixels nothing is known;
  /// Fault::Usage for heights of a view that is no photograph or has depth.
  Surface(Object object, int group, std::shared_ptr<const Picture> heights);

  SurfaceTile tile(int level, int x, int y) const;

 private:
  Object object_;
  int group_ = 0;
  ViewGeometry view_;
  std::shared_ptr<const Picture> heights_;
};

}  // namespace illum
