#include "convert/new_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>

#include "build/fill.h"
#include "build/quantiser.h"

namespace illum {
namespace {

// Planes and coverage of one tile, into its place in the view's picture.
void decodeInto(const Object& object, int group, int x, int y, Picture& picture) {
  const Manifest& manifest = object.manifest();
  const Rectangle tile = manifest.grid(group).tileRectangle(0, x, y);
  const int planes = object.basis(group).planes();
  const auto values = dequantise(manifest.coding(group), object.planeTile(group, 0, x, y), planes);
  const BytePicture mask = object.hasMask() ? object.maskTile(group, 0, x, y) : BytePicture();
  const std::size_t pixels = tile.pixels();
  for (int row = 0; row < tile.height; ++row) {
    for (int column = 0; column < tile.width; ++column) {
      const std::size_t i = Size{tile.width, row}.pixels() + static_cast<std::size_t>(column);
      const float coverage = mask.empty() ? 1.0F : static_cast<float>(mask.samples()[i]) / 255.0F;
      float* out = &picture.at(tile.x + column, tile.y + row, 0);
      for (std::size_t k = 0; k < static_cast<std::size_t>(planes); ++k)
        out[k] = coverage * values[k * pixels + i];
      out[planes] = coverage;
    }
  }
}

Picture planesOf(const Object& object, int group) {
  const TileGrid grid = object.manifest().grid(group);
  Picture picture(grid.size, object.basis(group).planes() + 1);
  const int across = grid.tilesAcross(0);
  tbb::parallel_for(0, across * grid.tilesDown(0),
                    [&](int i) { decodeInto(object, group, i % across, i / across, picture); });
  return picture;
}

}  // namespace

ObjectViews planeViews(const Object& object, const std::vector<int>& groups,
                       std::uint64_t memoryBytes) {
  ObjectViews views(object, memoryBytes, groups, object.basis(groups.front()).planes() + 1);
  views.setRelit([object](int group) { return planesOf(object, group); });
  return views;
}

NewView synthesisedPlanes(ObjectViews& views, const ViewGeometry& target,
                          const SynthesisOptions& options) {
  const SynthesisedView seen = synthesise(views, target, options);
  NewView view;
  view.size = seen.picture.size();
  const std::size_t pixels = view.size.pixels();
  const auto planes = static_cast<std::size_t>(views.channels()) - 1;
  view.values.resize(planes * pixels);
  view.coverage.resize(pixels);
  const auto samples = seen.picture.samples();
  tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t i) {
    const float* from = &samples[i * (planes + 1)];
    const float coverage = view.coverage[i] = std::clamp(from[planes], 0.0F, 1.0F);
    for (std::size_t k = 0; k < planes; ++k)
      view.values[k * pixels + i] = coverage > 0 ? from[k] / coverage : 0;
  });
  const auto depth = seen.depth.samples();
  view.depth.assign(depth.begin(), depth.end());
  if (!views.hasBackdrop()) return view;
  // Without a mask everything shows something; what nobody saw is continued smoothly.
  view.unseenPixels = static_cast<std::uint64_t>(std::ranges::count(view.coverage, 0.0F));
  if (view.unseenPixels > 0) fillHidden(view.values, view.coverage, view.size);
  return view;
}

PlaneRow NewView::tileRow(const Manifest& manifest, int group, int row) const {
  PlaneRow out;
  out.group = group;
  out.row = row;
  out.size = {size.width, std::min(manifest.tile, size.height - row * manifest.tile)};
  const std::size_t first = Size{size.width, row * manifest.tile}.pixels();
  const auto take = [&](std::span<const float> plane, std::vector<float>& to) {
    const auto part = plane.subspan(first, out.size.pixels());
    to.insert(to.end(), part.begin(), part.end());
  };
  for (std::size_t k = 0; k * size.pixels() < values.size(); ++k)
    take(std::span(values).subspan(k * size.pixels(), size.pixels()), out.values);
  if (manifest.mask) take(coverage, out.coverage);
  if (manifest.groups[static_cast<std::size_t>(group)].depth) take(depth, out.depth);
  return out;
}

}  // namespace illum
