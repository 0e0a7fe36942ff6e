#include "convert/new_view.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <span>
#include <utility>

#include "build/fill.h"

namespace illum {
namespace {

// Which planes of a group a picture shows, before its coverage.
struct Part {
  int first = 0, count = 0;
};

// Planes and coverage of one tile, into its place in the view's picture.
void decodeInto(const Object& object, int group, int x, int y, const Part& part, Picture& picture) {
  const Manifest& manifest = object.manifest();
  const Rectangle tile = manifest.grid(group).tileRectangle(0, x, y);
  const CodingEntry& coding = manifest.coding(group);
  const PlaneCodes codes = object.planeTile(group, 0, x, y);
  const BytePicture mask = object.hasMask() ? object.maskTile(group, 0, x, y) : BytePicture();
  const auto pixel = [&](std::size_t i) {
    const int row = static_cast<int>(i) / tile.width, column = static_cast<int>(i) % tile.width;
    return &picture.at(tile.x + column, tile.y + row, 0);
  };
  for (std::size_t i = 0; i < tile.pixels(); ++i) {
    pixel(i)[part.count] = mask.empty() ? 1.0F : static_cast<float>(mask.samples()[i]) / 255.0F;
  }
  // Several stored planes may be parts of one function.
  for (std::size_t p = 0; p < coding.functions.size(); ++p) {
    const int place = coding.functions[p] - part.first;
    if (place < 0 || place >= part.count) continue;
    for (std::size_t i = 0; i < tile.pixels(); ++i) {
      float* out = pixel(i);
      out[place] += out[part.count] *
                    static_cast<float>(valueOfCode(coding, p, codes.values[p * tile.pixels() + i]));
    }
  }
}

Picture planesOf(const Object& object, int group, const Part& part, int atOnce,
                 const StoppableProgress& progress) {
  const TileGrid grid = object.manifest().grid(group);
  Picture picture(grid.size, part.count + 1);
  const int across = grid.tilesAcross(0);
  tbb::task_arena arena(atOnce);
  arena.execute([&] {
    tbb::parallel_for(0, across * grid.tilesDown(0), [&](int i) {
      progress.check();
      decodeInto(object, group, i % across, i / across, part, picture);
    });
  });
  return picture;
}

}  // namespace

NewViewMaker::NewViewMaker(const Object& object, std::vector<int> groups,
                           const ConversionMemory& memory, const StoppableProgress& progress)
    : object_(object),
      progress_(progress),
      groups_(std::move(groups)),
      planes_(object.basis(groups_.front()).planes()),
      planesAtOnce_(std::min(planes_, memory.planesAtOnce)),
      tilesDecoded_(memory.tilesDecoded),
      views_(object, memory.viewBytes, groups_, planesAtOnce_ + 1) {}

void NewViewMaker::takePlanes(int first) {
  if (first == first_) return;
  first_ = first;
  const Part part{first, planesAtOnce_};
  views_.setRelit([object = object_, part, atOnce = tilesDecoded_, &progress = progress_](
                      int group) { return planesOf(object, group, part, atOnce, progress); });
}

void NewViewMaker::addPart(const SynthesisedView& seen, int first, NewView& view) const {
  const std::size_t pixels = view.size.pixels();
  const auto channels = static_cast<std::size_t>(planesAtOnce_) + 1;
  const auto planes = static_cast<std::size_t>(std::min(planesAtOnce_, planes_ - first));
  const std::span<float> values =
      std::span(view.values).subspan(static_cast<std::size_t>(first) * pixels, planes * pixels);
  const auto samples = seen.picture.samples();
  tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t i) {
    const float* from = &samples[i * channels];
    const float coverage = view.coverage[i] = std::clamp(from[channels - 1], 0.0F, 1.0F);
    for (std::size_t k = 0; k < planes; ++k)
      values[k * pixels + i] = coverage > 0 ? from[k] / coverage : 0;
  });
}

NewView NewViewMaker::make(const ViewGeometry& target, const SynthesisOptions& options) {
  NewView view;
  view.size = sizeOf(target);
  const std::size_t pixels = view.size.pixels();
  view.values.resize(static_cast<std::size_t>(planes_) * pixels);
  view.coverage.resize(pixels);
  for (int first = 0; first < planes_; first += planesAtOnce_) {
    progress_.check();
    takePlanes(first);
    const SynthesisedView seen = synthesise(views_, target, options);
    addPart(seen, first, view);
    if (first > 0) continue;
    const auto depth = seen.depth.samples();
    view.depth.assign(depth.begin(), depth.end());
  }
  if (!views_.hasBackdrop()) return view;
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
  const auto take = [&](std::span<const float> plane, auto& to) {
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
