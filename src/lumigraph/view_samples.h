// What one view knows of points that a target sees: its picture there, and whether it sees them.
#pragma once

#include <span>

#include "illum/picture.h"
#include "lumigraph/view_projector.h"

namespace illum {

/// Sums over views of one pixel of the target: after the picture's channels two more.
inline constexpr int kWeightSum = 0;   ///< of all views that have the point in their frame
inline constexpr int kVisibleSum = 1;  ///< of those that see it; the channels are weighted by this
inline constexpr int kExtraSums = 2;

/// What a view's pixels without depth tell of a point.
enum class Undefined {
  Nothing,    ///< that nothing is there: neither the point nor what would hide it
  Unrelated,  ///< nothing: they show a backdrop that is not where the point is
  Backdrop    ///< all: the point is on the backdrop that they show, behind all that has depth
};

/// A view and its pictures. Bilinear between the centres of pixels; where depth is known, only
/// between those of them that show the surface on which the point lies.
class ViewSamples {
 public:
  /// `depth` null: every point in the frame counts as seen.
  ViewSamples(const ViewProjector& target, const ViewProjector& view, const Picture& picture,
              const Picture* depth, Undefined undefined);

  /// Adds to each pixel's sums. Points with a weight of 0 are not looked at.
  void add(std::span<const Vector3> points, std::span<const float> weights,
           std::span<float> sums) const;

 private:
  struct Taps;
  Taps tapsAt(const Sighting& seen) const;
  float weighByDepth(Taps& taps, Vector3 point, const Sighting& seen) const;
  float agreement(Vector3 point, const Sighting& seen, double found) const;

  const ViewProjector& target_;
  const ViewProjector& view_;
  const Picture& picture_;
  const Picture* depth_;
  Undefined undefined_;
};

/// 1 well inside the view's picture, falling to 0 at its edges; 0 outside.
double frameFade(const ViewProjector& view, const Sighting& seen);

}  // namespace illum
