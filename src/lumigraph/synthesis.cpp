#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <numeric>

#include "illum/error.h"
#include "illum/lumigraph.h"
#include "lumigraph/blend_rule.h"
#include "lumigraph/default_focus.h"
#include "lumigraph/depth_mesh.h"
#include "lumigraph/view_samples.h"

namespace illum {
namespace {

// Where less than this part of what should see a point does, others are asked as well.
constexpr float kEnoughVisible = 0.5F;
// In pixels, by how much what is nearest may be displaced in a view that stands where the target
// does.
constexpr double kSamePlace = 0.01;
// Depth pictures of free cameras that are drawn: enough that what one does not see another does.
constexpr std::size_t kMostDrawnViews = 12;

// Views that are blended by one rule: those of one slab, or all free ones.
struct Rig {
  std::vector<int> views;           // of the source
  std::unique_ptr<BlendRule> rule;  // of a slab; that of free views depends on where surfaces are
};

bool isKnown(Vector3 point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

void addTo(Picture& sum, const Picture& more) {
  for (std::size_t i = 0; i < sum.samples().size(); ++i) sum.samples()[i] += more.samples()[i];
}

class Synthesis {
 public:
  Synthesis(ViewSource& source, const ViewGeometry& target, const SynthesisOptions& options)
      : source_(source),
        options_(options),
        byDepth_(source.hasDepth() && options.useDepth && !options.focus),
        target_(target),
        points_{target_.size(), std::vector<Vector3>(target_.size().pixels())},
        near_(target_.size(), source.channels() + kExtraSums) {
    for (const View& view : source.views()) projectors_.emplace_back(view.geometry);
    collectRigs();
  }

  SynthesisedView run() {
    if (byDepth_) {
      findSurface();
      seeSurface(source_.hasBackdrop() ? Undefined::Unrelated : Undefined::Nothing);
      SynthesisedView surface = resolved(true);
      if (!source_.hasBackdrop()) return surface;
      seeBackdrop(surface.depth);
      const SynthesisedView backdrop = resolved(false);
      addTo(surface.picture, backdrop.picture);
      return surface;
    }
    seePlane(Undefined::Nothing);
    return resolved(false);
  }

 private:
  void collectRigs();
  void findSurface();
  void seeSurface(Undefined undefined);
  void seePlane(Undefined undefined);
  void seeBackdrop(const Picture& surface);
  void placeOnPlane(const Rig& rig);
  void add(const Rig& rig, Ring ring, Undefined undefined, Picture& sums);
  void askMoreViews(Undefined undefined);
  SynthesisedView resolved(bool withDepth) const;

  std::unique_ptr<BlendRule> freeRule(const Rig& rig) const {
    std::vector<const ViewProjector*> views;
    for (const int view : rig.views) views.push_back(&projectors_[static_cast<std::size_t>(view)]);
    return freeBlend(target_, views, points_, options_.blendedViews);
  }
  const BlendRule& ruleOf(const Rig& rig) const { return rig.rule ? *rig.rule : *freeRule_; }
  const SlabView* slabView(int view) const {
    return std::get_if<SlabView>(&source_.views()[static_cast<std::size_t>(view)].geometry);
  }
  // Whether the view stands where the target stands, but for the rounding of poses.
  bool standsWithTarget(const ViewProjector& view) const {
    const double apart = length(view.eye() - target_.eye());
    return apart == 0 || apart < kSamePlace * target_.pixelWidth(nearestRange_);
  }
  // Whether any ray of the target asks for the view.
  bool isAsked(const Rig& rig, int local, Ring ring) const;
  std::vector<int> drawnViews(const Rig& rig) const;
  bool mayAsk(const Rig& rig, int local, int y, Ring ring) const {
    return (ring == Ring::Near || rowsWantMore_[static_cast<std::size_t>(y)] != 0) &&
           ruleOf(rig).asks(local, y, ring);
  }
  bool wantsMore(int x, int y) const {
    return isKnown(points_.row(y)[static_cast<std::size_t>(x)]) &&
           visibleShare(near_, x, y) < kEnoughVisible;
  }
  // Of row y: 0 where nothing more is wanted of the ring.
  void wantedWeights(const Rig& rig, int local, int y, Ring ring, std::span<float> weights) const;
  float visibleShare(const Picture& sums, int x, int y) const {
    const int channels = source_.channels();
    const float all = sums.at(x, y, channels + kWeightSum);
    return all > 0 ? sums.at(x, y, channels + kVisibleSum) / all : 0;
  }

  ViewSource& source_;
  SynthesisOptions options_;
  bool byDepth_;
  ViewProjector target_;
  std::deque<ViewProjector> projectors_;  // of the source's views
  std::vector<Rig> rigs_;
  SurfacePoints points_;
  std::unique_ptr<BlendRule> freeRule_;  // of the rig that is no slab, at the points
  Picture near_, wide_;                  // sums; the second is empty where it was not needed
  std::vector<std::uint8_t> rowsWantMore_;
  double nearestRange_ = 0;          // of the surface, from the target
  const Picture* hidden_ = nullptr;  // depth of the target where the plane is not seen
};

void Synthesis::collectRigs() {
  const int count = static_cast<int>(source_.views().size());
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  // Beside cameras that stand freely, a slab's view points are free cameras, too.
  if (std::ranges::any_of(all, [&](int view) { return slabView(view) == nullptr; })) {
    rigs_.push_back({std::move(all), nullptr});
    return;
  }
  std::vector<const LightSlab*> slabs;
  for (const int view : all) {
    const LightSlab& slab = slabView(view)->slab;
    const auto found =
        std::ranges::find_if(slabs, [&](const LightSlab* other) { return *other == slab; });
    if (found == slabs.end()) {
      slabs.push_back(&slab);
      rigs_.push_back({{view}, nullptr});
    } else {
      rigs_[static_cast<std::size_t>(found - slabs.begin())].views.push_back(view);
    }
  }
  for (Rig& rig : rigs_) {
    std::vector<SlabView> views;
    for (const int view : rig.views) views.push_back(*slabView(view));
    rig.rule = slabBlend(target_, views, points_, options_.apertureRadius);
  }
}

bool Synthesis::isAsked(const Rig& rig, int local, Ring ring) const {
  std::vector<float> weights(static_cast<std::size_t>(target_.size().width));
  for (int y = 0; y < target_.size().height; ++y) {
    if (!mayAsk(rig, local, y, ring)) continue;
    wantedWeights(rig, local, y, ring, weights);
    if (std::ranges::any_of(weights, [](float w) { return w > 0; })) return true;
  }
  return false;
}

void Synthesis::wantedWeights(const Rig& rig, int local, int y, Ring ring,
                              std::span<float> weights) const {
  ruleOf(rig).weights(local, y, ring, weights);
  if (ring == Ring::Near) return;
  for (int x = 0; x < target_.size().width; ++x) {
    if (!wantsMore(x, y)) weights[static_cast<std::size_t>(x)] = 0;
  }
}

// Of a slab, all that its rule asks for, since that depends on rays alone, and its outposts. Of
// free cameras, those that stand and look most like the target.
std::vector<int> Synthesis::drawnViews(const Rig& rig) const {
  std::vector<int> drawn;
  if (rig.rule) {
    const std::vector<int> outposts = rig.rule->outposts();
    for (int local = 0; local < static_cast<int>(rig.views.size()); ++local) {
      if (std::ranges::count(outposts, local) > 0 || isAsked(rig, local, Ring::Near))
        drawn.push_back(rig.views[static_cast<std::size_t>(local)]);
    }
    return drawn;
  }
  drawn = rig.views;
  std::vector<double> unlike(source_.views().size());
  double spread = 0;
  for (const int v : drawn) {
    spread += length(projectors_[static_cast<std::size_t>(v)].eye() - target_.eye()) /
              static_cast<double>(drawn.size());
  }
  for (const int v : drawn) {
    const ViewProjector& view = projectors_[static_cast<std::size_t>(v)];
    const double apart = length(view.eye() - target_.eye());
    unlike[static_cast<std::size_t>(v)] =
        (spread > 0 ? apart / spread : 0) + length(view.axis() - target_.axis());
  }
  std::stable_sort(drawn.begin(), drawn.end(), [&](int a, int b) {
    return unlike[static_cast<std::size_t>(a)] < unlike[static_cast<std::size_t>(b)];
  });
  drawn.resize(std::min(drawn.size(), kMostDrawnViews));
  return drawn;
}

// The outline of one view, where pixels are covered in part, stands before the middle of what
// another view sees. So outlines, and what is thinner than a pixel, count only where nothing else
// is.
void Synthesis::findSurface() {
  RangeBuffer whole(target_), all(target_);
  for (const Rig& rig : rigs_) {
    for (const int view : drawnViews(rig)) {
      const auto depth = source_.depth(view);
      const auto picture = source_.picture(view);
      const ViewProjector& projector = projectors_[static_cast<std::size_t>(view)];
      drawDepth(projector, *depth, picture.get(), whole);
      drawDepth(projector, *depth, nullptr, all);
    }
  }
  tbb::parallel_for(0, target_.size().height, [&](int y) {
    const auto points = points_.row(y);
    for (int x = 0; x < target_.size().width; ++x) {
      const double range = whole.range(x, y) < kNothing ? whole.range(x, y) : all.range(x, y);
      points[static_cast<std::size_t>(x)] = range < kNothing
                                                ? target_.pointAt(x + 0.5, y + 0.5, range)
                                                : Vector3{kNothing, kNothing, kNothing};
    }
  });
  nearestRange_ = std::min(all.nearest(), whole.nearest());
  if (!(nearestRange_ < kNothing)) nearestRange_ = 0;
}

void Synthesis::seeSurface(Undefined undefined) {
  for (const Rig& rig : rigs_) {
    if (!rig.rule) freeRule_ = freeRule(rig);
    add(rig, Ring::Near, undefined, near_);
  }
  askMoreViews(undefined);
}

void Synthesis::seePlane(Undefined undefined) {
  for (const Rig& rig : rigs_) {
    placeOnPlane(rig);
    if (!rig.rule) freeRule_ = freeRule(rig);
    add(rig, Ring::Near, undefined, near_);
  }
}

// Rays that met no surface end on the plane.
void Synthesis::seeBackdrop(const Picture& surface) {
  hidden_ = &surface;
  std::ranges::fill(near_.samples(), 0.0F);
  wide_ = {};
  seePlane(Undefined::Backdrop);
}

void Synthesis::placeOnPlane(const Rig& rig) {
  const SlabView* slab = rig.rule ? slabView(rig.views.front()) : nullptr;
  std::vector<const ViewProjector*> views;
  for (const int view : rig.views) views.push_back(&projectors_[static_cast<std::size_t>(view)]);
  const bool photograph = std::holds_alternative<OrthographicView>(
      source_.views()[static_cast<std::size_t>(rig.views.front())].geometry);
  const std::optional<Plane> plane = options_.focus ? options_.focus
                                     : slab         ? windowOf(slab->slab)
                                     : photograph   ? Plane()
                                                    : planeLookedAt(views);
  // What a slab saw along a line, it saw of all of it, also behind the eye.
  const bool wholeLine = slab != nullptr;
  tbb::parallel_for(0, target_.size().height, [&](int y) {
    const auto points = points_.row(y);
    for (int x = 0; x < target_.size().width; ++x) {
      points[static_cast<std::size_t>(x)] =
          hidden_ != nullptr && std::isfinite(hidden_->at(x, y, 0))
              ? Vector3{kNothing, kNothing, kNothing}
              : onPlane(target_.ray(x + 0.5, y + 0.5), plane, wholeLine);
    }
  });
}

void Synthesis::add(const Rig& rig, Ring ring, Undefined undefined, Picture& sums) {
  for (int local = 0; local < static_cast<int>(rig.views.size()); ++local) {
    if (!isAsked(rig, local, ring)) continue;
    const int view = rig.views[static_cast<std::size_t>(local)];
    const auto picture = source_.picture(view);
    const ViewProjector& projector = projectors_[static_cast<std::size_t>(view)];
    // What stands where the target stands sees what the target sees, whatever others say of depth.
    const bool asksDepth = byDepth_ && !standsWithTarget(projector);
    const auto depth = asksDepth ? source_.depth(view) : nullptr;
    const ViewSamples samples(target_, projector, *picture, depth.get(), undefined);
    tbb::parallel_for(tbb::blocked_range<int>(0, target_.size().height), [&](const auto& rows) {
      std::vector<float> weights(static_cast<std::size_t>(target_.size().width));
      for (int y = rows.begin(); y < rows.end(); ++y) {
        if (!mayAsk(rig, local, y, ring)) continue;
        wantedWeights(rig, local, y, ring, weights);
        const auto points = points_.row(y);
        for (std::size_t x = 0; x < weights.size(); ++x) {
          if (!isKnown(points[x])) weights[x] = 0;
        }
        samples.add(points, weights, sums.row(y));
      }
    });
  }
}

void Synthesis::askMoreViews(Undefined undefined) {
  rowsWantMore_.assign(static_cast<std::size_t>(target_.size().height), 0);
  for (int y = 0; y < target_.size().height; ++y) {
    for (int x = 0; x < target_.size().width; ++x) {
      if (wantsMore(x, y)) rowsWantMore_[static_cast<std::size_t>(y)] = 1;
    }
  }
  if (std::ranges::count(rowsWantMore_, 1) == 0) return;
  wide_ = Picture(near_.size(), near_.channels());
  for (const Rig& rig : rigs_) add(rig, Ring::Wide, undefined, wide_);
}

SynthesisedView Synthesis::resolved(bool withDepth) const {
  const int channels = source_.channels();
  SynthesisedView result{Picture(target_.size(), channels), {}};
  if (withDepth) result.depth = Picture(target_.size(), 1);
  tbb::parallel_for(0, target_.size().height, [&](int y) {
    for (int x = 0; x < target_.size().width; ++x) {
      const float nearVisible = near_.at(x, y, channels + kVisibleSum);
      const float wideVisible = wide_.empty() ? 0 : wide_.at(x, y, channels + kVisibleSum);
      float nearShare = std::min(1.0F, visibleShare(near_, x, y) / kEnoughVisible);
      if (!(wideVisible > 0)) nearShare = 1;
      const float byNear = nearVisible > 0 ? nearShare / nearVisible : 0;
      const float byWide = wideVisible > 0 ? (1 - nearShare) / wideVisible : 0;
      for (int c = 0; c < channels; ++c) {
        const float wide = byWide > 0 ? byWide * wide_.at(x, y, c) : 0;
        result.picture.at(x, y, c) = byNear * near_.at(x, y, c) + wide;
      }
      if (!withDepth) continue;
      Sighting seen;
      const bool shown = (byNear > 0 || byWide > 0) &&
                         target_.see(points_.row(y)[static_cast<std::size_t>(x)], seen);
      result.depth.at(x, y, 0) = static_cast<float>(shown ? target_.depthOf(seen.range) : kNothing);
    }
  });
  return result;
}

void checkOptions(const SynthesisOptions& options, const ViewGeometry& target) {
  if (options.blendedViews < 1 || options.blendedViews > 64) {
    throw Error(Fault::Usage,
                fmt::format("expected 1 to 64 views to blend, found {}", options.blendedViews));
  }
  if (!(options.apertureRadius >= 0) || !std::isfinite(options.apertureRadius)) {
    throw Error(Fault::Usage, fmt::format("expected an aperture of at least 0, found {}",
                                          options.apertureRadius));
  }
  if (options.focus && !(length(options.focus->normal) > 0)) {
    throw Error(Fault::Usage, "expected a focal plane with a normal, found one of length 0");
  }
  const Size size = sizeOf(target);
  if (size.width < 1 || size.height < 1) {
    throw Error(Fault::Usage, fmt::format("expected a picture of at least one pixel, found {}x{}",
                                          size.width, size.height));
  }
}

}  // namespace

SynthesisedView synthesise(ViewSource& source, const ViewGeometry& target,
                           const SynthesisOptions& options) {
  if (source.views().empty()) throw Error(Fault::Input, "expected at least one view, found none");
  checkOptions(options, target);
  return Synthesis(source, target, options).run();
}

}  // namespace illum
