#include "build/tile_writer.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "build/fill.h"
#include "build/quantiser.h"
#include "codec/depth_tile.h"

namespace illum {
namespace {

// Rounded to the nearest step.
std::uint16_t codeOf(const DepthRange& range, float depth) {
  if (!std::isfinite(depth)) return kNoDepth;
  const double extent = std::max(range.to - range.from, std::numeric_limits<double>::min());
  const double steps = std::round((static_cast<double>(depth) - range.from) / extent * range.steps);
  return static_cast<std::uint16_t>(std::clamp<double>(steps, 0, range.steps));
}

// The part of a row's array (count x row.size) that lies under a tile, as count x tile.
std::vector<float> cut(std::span<const float> values, Size row, const Rectangle& tile) {
  const std::size_t count = values.size() / row.pixels();
  std::vector<float> out;
  out.reserve(count * tile.pixels());
  for (std::size_t k = 0; k < count; ++k) {
    for (int y = 0; y < tile.height; ++y) {
      const float* from = values.data() + k * row.pixels() +
                          static_cast<std::size_t>(y) * static_cast<std::size_t>(row.width) +
                          static_cast<std::size_t>(tile.x);
      out.insert(out.end(), from, from + tile.width);
    }
  }
  return out;
}

// Of a sample: libaom's frames and side data; a picture and its file. Estimates that the tests of
// --max-memory hold, not measurements.
std::uint64_t coderBytes(const CodingEntry& coding) {
  return coding.coding == Coding::Avif ? 24 : 8;
}

}  // namespace

void TileWriter::write(const PlaneRow& row) {
  // Nested parallelism inside a coder would let more than `atOnce` tiles live.
  tbb::task_arena arena(atOnce_);
  arena.execute([&] {
    tbb::parallel_for(
        0, manifest_.grid(row.group).tilesAcross(row.level),
        [&](int x) {
          writeTile(row, x);
          if (manifest_.mask) writeMask(row, x);
          if (!row.depth.empty()) writeDepth(row, x);
          if (row.level > 0) return;
          progress_.advance(manifest_.grid(row.group).tileRectangle(0, x, row.row).pixels());
        },
        tbb::simple_partitioner());
  });
}

void TileWriter::writeTile(const PlaneRow& row, int x) {
  const std::string name = planeTileName(manifest_, row.group, row.level, x, row.row);
  if (writer_.has(name)) return;
  const Rectangle tile = manifest_.grid(row.group).tileRectangle(row.level, x, row.row);
  auto planes = cut(row.values, row.size, tile);
  if (manifest_.mask) fillHidden(planes, cut(row.coverage, row.size, tile), tile.size());
  std::uint64_t clipped = 0;
  const CodingEntry& coding = manifest_.coding(row.group);
  const auto codes = quantise(coding, planes, tile.size(), clipped);
  samples_ += planes.size();
  clipped_ += clipped;
  writer_.add(name, encodeTile(codes, coding.coding, coding.bits, settings_));
}

void TileWriter::writeMask(const PlaneRow& row, int x) {
  const std::string name = maskTileName(manifest_, row.group, row.level, x, row.row);
  if (writer_.has(name)) return;
  const Rectangle tile = manifest_.grid(row.group).tileRectangle(row.level, x, row.row);
  const auto coverage = cut(row.coverage, row.size, tile);
  BytePicture picture(tile.size(), 1);
  std::transform(coverage.begin(), coverage.end(), picture.samples().begin(), byteFromUnit);
  writer_.add(name, encodeMaskTile(picture));
}

void TileWriter::writeDepth(const PlaneRow& row, int x) {
  const std::string name = depthTileName(manifest_, row.group, row.level, x, row.row);
  if (writer_.has(name)) return;
  const Rectangle tile = manifest_.grid(row.group).tileRectangle(row.level, x, row.row);
  const DepthRange& range = *manifest_.groups[static_cast<std::size_t>(row.group)].depth;
  std::vector<std::uint16_t> codes;
  for (const float depth : cut(row.depth, row.size, tile)) codes.push_back(codeOf(range, depth));
  writer_.add(name, encodeDepthTile(codes, tile.size(), range.steps));
}

std::uint64_t tileCodingBytes(const Manifest& manifest, std::span<const int> planesOfBases) {
  std::uint64_t most = 0;
  for (int g = 0; g < static_cast<int>(manifest.groups.size()); ++g) {
    const auto basis = static_cast<std::size_t>(manifest.groups[static_cast<std::size_t>(g)].basis);
    const std::uint64_t pixels = manifest.grid(g).tileRectangle(0, 0, 0).pixels();
    const auto planes = static_cast<std::uint64_t>(planesOfBases[basis]);
    const auto stored = static_cast<std::uint64_t>(manifest.coding(g).planes());
    // Planes cut out as floats, codes, and what the coder has.
    most = std::max(most, pixels * (4 * planes + (2 + coderBytes(manifest.coding(g))) * stored));
  }
  return most;
}

}  // namespace illum
