// How much each view counts for each ray of a target.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "illum/lumigraph.h"
#include "lumigraph/view_projector.h"

namespace illum {

/// The point at which a target's ray through each pixel meets what it is taken to see. Coordinates
/// that are not numbers: nothing.
struct SurfacePoints {
  Size size;
  std::vector<Vector3> points;

  std::span<Vector3> row(int y) { return {points.data() + offset(y), width()}; }
  std::span<const Vector3> row(int y) const { return {points.data() + offset(y), width()}; }

 private:
  std::size_t width() const { return static_cast<std::size_t>(size.width); }
  std::size_t offset(int y) const { return static_cast<std::size_t>(y) * width(); }
};

/// Which views are asked: those that know best, or, where none of them sees a point, more: of a
/// slab, those around the nearest place from which the window shows the point.
enum class Ring { Near, Wide };

/// Of some of a source's views, counted here from 0. Const members are thread safe.
class BlendRule {
 public:
  virtual ~BlendRule() = default;
  /// Of view `view` for the pixels of row `y`; >= 0, in any unit that all views share.
  virtual void weights(int view, int y, Ring ring, std::span<float> weights) const = 0;
  /// Takes next to no time. False: all weights of the row are 0; they may be where it is true.
  virtual bool asks(int view, int y, Ring ring) const = 0;
  /// Views that may know of surfaces which none of the near ring shows.
  virtual std::vector<int> outposts() const { return {}; }
};

/// For views of one slab: each ray meets the uv plane somewhere; view points near it count, by the
/// bilinear kernel (Levoy and Hanrahan 1996) or by an aperture (Isaksen et al. 2000). Rays that
/// pass outside the grid of view points were not seen. `points`, which the wide ring is for, may
/// change; they outlive the rule.
std::unique_ptr<BlendRule> slabBlend(const ViewProjector& target, std::span<const SlabView> views,
                                     const SurfacePoints& points, double apertureRadius);

/// For views from anywhere: those that see a point from nearly the same direction, as finely, and
/// well inside their frames count (Buehler et al. 2001, section 4). `points` is copied from.
std::unique_ptr<BlendRule> freeBlend(const ViewProjector& target,
                                     std::span<const ViewProjector* const> views,
                                     const SurfacePoints& points, int blendedViews);

}  // namespace illum
