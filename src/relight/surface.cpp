#include "relight/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "illum/error.h"
#include "object/manifest.h"

namespace illum {
namespace {

/// The view as it is seen in its group's own frame.
ViewGeometry inOwnFrame(ViewGeometry view) {
  if (auto* slab = std::get_if<SlabView>(&view)) slab->slab.objectFromSlab = {};
  return view;
}

void checkHeights(const Picture& heights, Size size) {
  if (heights.size() != size) {
    throw Error(Fault::Input,
                fmt::format("heights: expected {} x {} pixels as the object has, found "
                            "{} x {}",
                            size.width, size.height, heights.width(), heights.height()));
  }
  const auto samples = heights.samples();
  if (!std::all_of(samples.begin(), samples.end(), [](float z) { return std::isfinite(z); }))
    throw Error(Fault::Input, "heights: expected finite numbers, found others");
}

/// A pixel of a coarser level lies where the pixels of level 0 that it stands for lie in the mean.
float meanHeight(const Picture& heights, int scale, int column, int row) {
  const int right = std::min((column + 1) * scale, heights.width());
  const int bottom = std::min((row + 1) * scale, heights.height());
  double sum = 0;
  for (int y = row * scale; y < bottom; ++y) {
    for (int x = column * scale; x < right; ++x) sum += heights.at(x, y, 0);
  }
  return static_cast<float>(sum / ((right - column * scale) * (bottom - row * scale)));
}

}  // namespace

void SurfaceTile::points(int left, int row, std::span<Vector3> out) const {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int column = left + static_cast<int>(i);
    const float depth = depth_.empty() ? 0 : depth_[Size{tile_.width, row}.pixels() + column];
    const PixelPosition centre{(tile_.x + column + 0.5) * scale_, (tile_.y + row + 0.5) * scale_};
    out[i] = std::isfinite(depth) ? pointAt(view_, centre, depth)
                                  : Vector3{kNothing, kNothing, kNothing};
  }
}

Surface::Surface(Object object, int group, std::shared_ptr<const Picture> heights)
    : object_(std::move(object)),
      group_(group),
      view_(inOwnFrame(object_.view(group).geometry)),
      heights_(std::move(heights)) {
  const bool photograph = std::holds_alternative<OrthographicView>(view_);
  const bool depth = object_.hasDepth(group);
  if (heights_ && (depth || !photograph)) {
    throw Error(Fault::Usage,
                fmt::format("{}: heights are for photographs without depth, this view {}",
                            object_.path().string(), depth ? "has depth" : "is no photograph"));
  }
  if (heights_) checkHeights(*heights_, object_.size(group));
  if (!depth && !photograph && !std::holds_alternative<SlabView>(view_)) {
    throw inputError(object_.path(),
                     "depth, as lights near a camera's or panorama's object need it", "none");
  }
}

SurfaceTile Surface::tile(int level, int x, int y) const {
  SurfaceTile surface;
  surface.view_ = view_;
  surface.tile_ = object_.manifest().grid(group_).tileRectangle(level, x, y);
  surface.scale_ = 1 << level;
  if (object_.hasDepth(group_)) surface.depth_ = object_.depthTile(group_, level, x, y);
  if (heights_) {
    for (int row = surface.tile_.y; row < surface.tile_.bottom(); ++row) {
      for (int column = surface.tile_.x; column < surface.tile_.right(); ++column)
        surface.depth_.push_back(meanHeight(*heights_, surface.scale_, column, row));
    }
  }
  return surface;
}

}  // namespace illum
