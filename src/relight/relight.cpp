#include "illum/relight.h"

#include <fmt/format.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "illum/error.h"
#include "object/manifest.h"
#include "relight/tile_cache.h"
#include "relight/weighted_sum.h"

namespace illum {
namespace {

void checkRequest(const Object& object, int group, int level) {
  if (group < 0 || group >= object.groups()) {
    throw Error(Fault::Usage, fmt::format("{}: there is no group of views {}, only 0 to {}",
                                          object.path().string(), group, object.groups() - 1));
  }
  if (level < 0 || level >= object.levels(group)) {
    throw Error(Fault::Usage, fmt::format("{}: there is no level {}, only 0 to {}",
                                          object.path().string(), level, object.levels(group) - 1));
  }
}

void checkRegion(const Object& object, const Rectangle& region, Size size) {
  if (region.x >= 0 && region.y >= 0 && region.width > 0 && region.height > 0 &&
      region.width <= size.width - region.x && region.height <= size.height - region.y) {
    return;
  }
  throw Error(Fault::Usage,
              fmt::format("{}: there is no region {}x{} at ({}, {}), only {}x{} pixels",
                          object.path().string(), region.width, region.height, region.x, region.y,
                          size.width, size.height));
}

// Lights are given in the object frame, the basis is a function of the group's own.
Direction inGroup(const View& view, Direction toLight) {
  const RigidTransform objectFromView = objectFromGroup(view.geometry);
  if (objectFromView.rotation == RigidTransform().rotation) return toLight;
  return inverse(objectFromView).direction(toLight);
}

// One set of weights per pass over the planes: a linear response lets all lights share one.
struct Pass {
  FoldedWeights weights;
  LinearRgb intensity{1, 1, 1};  // applied behind the response
};

std::vector<Pass> passesFor(const Object& object, int group,
                            std::span<const DirectionalLight> lights) {
  const LightBasis& basis = object.basis(group);
  const CodingEntry& coding = object.manifest().coding(group);
  const bool linear = object.manifest().response == Response::Linear;
  std::vector<Pass> passes;
  for (const DirectionalLight& light : lights) {
    const Direction toLight = inGroup(object.view(group), light.toLight);
    if (!linear) {
      passes.push_back({foldWeights(basis, coding, toLight), light.intensity});
      continue;
    }
    const auto folded = foldWeights(basis, coding, toLight, light.intensity);
    if (passes.empty()) {
      passes.push_back({folded, {}});
    } else {
      addWeights(passes.front().weights, folded);
    }
  }
  return passes;
}

// Linear RGB of `texels` texels of a tile from `first` on.
void relightTexels(const PlaneCodes& codes, const CodingEntry& coding, Response response,
                   std::span<const Pass> passes, std::size_t first, std::span<float> rgb,
                   std::vector<float>& scratch) {
  if (response == Response::Linear && !passes.empty()) {
    weightedSum(codes, coding, passes.front().weights, first, rgb);
    return;
  }
  std::fill(rgb.begin(), rgb.end(), 0.0f);
  scratch.resize(rgb.size());
  for (const Pass& pass : passes) {
    weightedSum(codes, coding, pass.weights, first, scratch);
    applyResponse(response, scratch);
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
      rgb[i] += pass.intensity.r * scratch[i];
      rgb[i + 1] += pass.intensity.g * scratch[i + 1];
      rgb[i + 2] += pass.intensity.b * scratch[i + 2];
    }
  }
}

// `mask`: the texels' coverage; empty for a picture without alpha.
void storeRow(std::span<const float> rgb, std::span<const std::uint8_t> mask, float* out) {
  if (mask.empty()) {
    std::copy(rgb.begin(), rgb.end(), out);
    return;
  }
  for (std::size_t x = 0; x < mask.size(); ++x, out += 4) {
    const float coverage = static_cast<float>(mask[x]) / 255.0f;
    for (std::size_t c = 0; c < 3; ++c) out[c] = coverage * rgb[3 * x + c];
    out[3] = coverage;
  }
}

Rectangle intersection(const Rectangle& a, const Rectangle& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::min(a.right(), b.right()) - x, std::min(a.bottom(), b.bottom()) - y};
}

}  // namespace

struct Relighter::State {
  State(Object object, std::uint64_t memoryBytes) : cache(std::move(object), memoryBytes) {}
  mutable TileCache cache;
};

Relighter::Relighter(Object object, std::uint64_t memoryBytes)
    : state_(std::make_unique<State>(std::move(object), memoryBytes)) {}
Relighter::~Relighter() = default;

Picture Relighter::relight(std::span<const DirectionalLight> lights, int group, int level) const {
  const Object& object = state_->cache.object();
  checkRequest(object, group, level);
  const Size size = object.manifest().grid(group).sizeAt(level);
  return relightRegion(lights, {0, 0, size.width, size.height}, group, level);
}

Picture Relighter::relightRegion(std::span<const DirectionalLight> lights, const Rectangle& region,
                                 int group, int level) const {
  const Object& object = state_->cache.object();
  checkRequest(object, group, level);
  const Manifest& manifest = object.manifest();
  const TileGrid grid = manifest.grid(group);
  checkRegion(object, region, grid.sizeAt(level));
  const auto passes = passesFor(object, group, lights);
  Picture picture(region.size(), manifest.mask ? 4 : 3);

  const auto relightTile = [&](int x, int y) {
    const Rectangle tile = grid.tileRectangle(level, x, y);
    const Rectangle part = intersection(tile, region);
    const auto codes = state_->cache.planes({group, level, x, y});
    const BytePicture mask = manifest.mask ? object.maskTile(group, level, x, y) : BytePicture();
    const auto width = static_cast<std::size_t>(part.width);
    const auto left = static_cast<std::size_t>(part.x - tile.x);
    tbb::parallel_for(tbb::blocked_range<int>(part.y, part.bottom(), 16), [&](const auto& rows) {
      std::vector<float> rgb(3 * width), scratch;
      for (int row = rows.begin(); row < rows.end(); ++row) {
        const auto first = Size{tile.width, row - tile.y}.pixels() + left;
        relightTexels(*codes, manifest.coding(group), manifest.response, passes, first, rgb,
                      scratch);
        storeRow(rgb, mask.empty() ? mask.samples() : mask.row(row - tile.y).subspan(left, width),
                 &picture.at(part.x - region.x, row - region.y, 0));
      }
    });
  };
  const auto endTile = [&](int end) { return (end - 1) / manifest.tile + 1; };
  tbb::parallel_for(
      tbb::blocked_range2d<int>(region.y / manifest.tile, endTile(region.bottom()), 1,
                                region.x / manifest.tile, endTile(region.right()), 1),
      [&](const auto& range) {
        for (int y = range.rows().begin(); y < range.rows().end(); ++y) {
          for (int x = range.cols().begin(); x < range.cols().end(); ++x) relightTile(x, y);
        }
      },
      tbb::simple_partitioner());
  return picture;
}

}  // namespace illum
