#include "build/plane_row.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace illum {
namespace {

// Pixels of a row that are fitted at once: their samples under 60 lights as floats (360 kB) stay in
// the second-level cache between reading and fitting, and runs are long enough for memory to be
// read in order.
constexpr int kPatchWidth = 512;

// Sizes `out` for a row of tiles. What was in it stays where it is not written.
void beginRow(const Manifest& manifest, std::size_t planes, int group, int level, int row,
              PlaneRow& out) {
  const Size whole = manifest.grid(group).sizeAt(level);
  out.group = group;
  out.level = level;
  out.row = row;
  out.size = {whole.width, std::min(manifest.tile, whole.height - row * manifest.tile)};
  out.values.resize(planes * out.size.pixels());
  if (manifest.mask) out.coverage.resize(out.size.pixels());
  const bool hasDepth = manifest.groups[static_cast<std::size_t>(group)].depth.has_value();
  out.depth.resize(hasDepth ? out.size.pixels() : 0);
}

// Of four depths, infinity where nothing is; the lower one of two in the middle. Never a mean: what
// is between two surfaces is on neither.
float medianDepth(std::array<float, 4> depths) {
  std::sort(depths.begin(), depths.end());
  const auto seen =
      std::count_if(depths.begin(), depths.end(), [](float depth) { return std::isfinite(depth); });
  return depths[static_cast<std::size_t>(std::max<std::ptrdiff_t>(seen - 1, 0) / 2)];
}

}  // namespace

struct RowFitter::Scratch {
  std::vector<float> samples, planes, values;
  std::vector<std::uint8_t> bytes;
};

struct RowFitter::State {
  tbb::enumerable_thread_specific<Scratch> scratches;
};

RowFitter::RowFitter(const Capture& capture, std::span<const int> lights,
                     std::vector<const PlaneOperator*> operators, const Manifest& manifest,
                     Progress& progress)
    : capture_(capture),
      lights_(lights),
      operators_(std::move(operators)),
      manifest_(manifest),
      progress_(progress),
      state_(std::make_unique<State>()) {
  const bool picks =
      std::ranges::any_of(operators_, [](const PlaneOperator* op) { return !op->picks.empty(); });
  if (capture.bytes() == nullptr || picks) return;
  for (const PlaneOperator* op : operators_) byteOperators_.emplace_back(*op);
}
RowFitter::~RowFitter() = default;

std::size_t RowFitter::basisOf(int group) const {
  return static_cast<std::size_t>(manifest_.groups[static_cast<std::size_t>(group)].basis);
}

// The planes of one patch, into the scratch.
void RowFitter::readPlanes(const Rectangle& patch, Scratch& scratch) const {
  const std::size_t pixels = patch.pixels(), samples = 3 * lights_.size() * pixels;
  const std::size_t basis = basisOf(row_.group);
  scratch.planes.resize(static_cast<std::size_t>(operators_[basis]->planes) * pixels);
  if (byteOperators_.empty()) {
    scratch.samples.resize(samples);
    capture_.read(row_.group, patch, lights_, scratch.samples);
    operators_[basis]->apply(scratch.samples, pixels, scratch.planes);
  } else {
    scratch.bytes.resize(samples);
    capture_.bytes()->readBytes(row_.group, patch, lights_, scratch.bytes);
    byteOperators_[basis].apply(scratch.bytes, pixels, scratch.planes);
  }
}

// Fits one patch, a part of a row (in picture coordinates), into the row of tiles that begins at
// picture row `top`.
void RowFitter::fitPatch(const Rectangle& patch, int top, Scratch& scratch) {
  readPlanes(patch, scratch);
  const std::size_t pixels = patch.pixels(), planes = scratch.planes.size() / pixels;
  const auto at =
      static_cast<std::size_t>(patch.y - top) * static_cast<std::size_t>(row_.size.width) +
      static_cast<std::size_t>(patch.x);
  const auto store = [&](const float* from, float* plane) {
    std::copy_n(from, pixels, plane + at);
  };
  for (std::size_t k = 0; k < planes; ++k) {
    store(scratch.planes.data() + k * pixels, row_.values.data() + k * row_.size.pixels());
  }
  scratch.values.resize(pixels);
  if (!row_.coverage.empty()) {
    capture_.readMask(row_.group, patch, scratch.values);
    store(scratch.values.data(), row_.coverage.data());
  }
  if (!row_.depth.empty()) {
    capture_.readDepth(row_.group, patch, scratch.values);
    store(scratch.values.data(), row_.depth.data());
  }
  progress_.advance(pixels);
}

const PlaneRow& RowFitter::fit(int group, int row) {
  beginRow(manifest_, static_cast<std::size_t>(operators_[basisOf(group)]->planes), group, 0, row,
           row_);
  const int top = row * manifest_.tile, bottom = top + row_.size.height;
  const int across = (row_.size.width + kPatchWidth - 1) / kPatchWidth;
  for (int y = top; y < bottom;) {
    // Never across the border of two bands: a sequential capture would have to go back.
    const int bandEnd = (y / capture_.bandRows() + 1) * capture_.bandRows();
    const int end = std::min(bottom, bandEnd);
    tbb::parallel_for(0, across * (end - y), [&](int i) {
      const int x = i % across * kPatchWidth;
      const Rectangle patch{x, y + i / across, std::min(kPatchWidth, row_.size.width - x), 1};
      fitPatch(patch, top, state_->scratches.local());
    });
    y = end;
  }
  return row_;
}

std::uint64_t planeRowBytes(const Manifest& manifest, std::span<const int> planesOfBases) {
  std::uint64_t most = 0;
  for (const GroupEntry& group : manifest.groups) {
    const Size size = sizeOf(group.view.geometry);
    const auto planes =
        static_cast<std::uint64_t>(planesOfBases[static_cast<std::size_t>(group.basis)]);
    const auto pixels = Size{size.width, std::min(manifest.tile, size.height)}.pixels();
    most = std::max<std::uint64_t>(most, pixels * (planes + 2) * sizeof(float));
  }
  return 2 * most;  // level l in flight is half as wide as level l-1
}

void LevelPyramid::add(const PlaneRow& row) {
  emit_(row);
  const TileGrid grid = manifest_.grid(row.group);
  const int next = row.level + 1;
  if (next >= grid.levels()) return;
  pending_.resize(std::max(pending_.size(), static_cast<std::size_t>(grid.levels())));
  auto& pending = pending_[static_cast<std::size_t>(next)];
  const std::size_t planes = row.values.size() / row.size.pixels();
  if (row.row % 2 == 0) beginRow(manifest_, planes, row.group, next, row.row / 2, pending);
  shrinkInto(row, pending);
  if (row.row % 2 == 1 || row.row == grid.tilesDown(row.level) - 1) add(pending);
}

void LevelPyramid::shrinkInto(const PlaneRow& fine, PlaneRow& coarse) const {
  const int top = fine.row % 2 * (manifest_.tile / 2);
  const int height = (fine.size.height + 1) / 2;
  const std::size_t planes = fine.values.size() / fine.size.pixels();
  const auto fineWidth = static_cast<std::size_t>(fine.size.width);
  // The mean over the block's texels inside the picture; hidden ones count little, but are never
  // lost.
  const auto weightOf = [&](std::size_t i) {
    return fine.coverage.empty() ? 1.0f : fine.coverage[i] + 1e-6f;
  };
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < coarse.size.width; ++x) {
      std::size_t texels[4];
      std::size_t count = 0;
      for (int dy = 0; dy < 2 && 2 * y + dy < fine.size.height; ++dy) {
        for (int dx = 0; dx < 2 && 2 * x + dx < fine.size.width; ++dx) {
          texels[count++] = static_cast<std::size_t>(2 * y + dy) * fineWidth +
                            static_cast<std::size_t>(2 * x + dx);
        }
      }
      const auto to =
          static_cast<std::size_t>(top + y) * static_cast<std::size_t>(coarse.size.width) +
          static_cast<std::size_t>(x);
      float weights[4], sum = 0, covered = 0;
      for (std::size_t i = 0; i < count; ++i) sum += weights[i] = weightOf(texels[i]);
      for (std::size_t k = 0; k < planes; ++k) {
        const float* plane = fine.values.data() + k * fine.size.pixels();
        float mean = 0;
        for (std::size_t i = 0; i < count; ++i) mean += weights[i] * plane[texels[i]];
        coarse.values[k * coarse.size.pixels() + to] = mean / sum;
      }
      if (!fine.depth.empty()) {
        std::array<float, 4> depths;
        depths.fill(std::numeric_limits<float>::infinity());
        for (std::size_t i = 0; i < count; ++i) depths[i] = fine.depth[texels[i]];
        coarse.depth[to] = medianDepth(depths);
      }
      if (fine.coverage.empty()) continue;
      for (std::size_t i = 0; i < count; ++i) covered += fine.coverage[texels[i]];
      coarse.coverage[to] = covered / static_cast<float>(count);
    }
  });
}

}  // namespace illum
