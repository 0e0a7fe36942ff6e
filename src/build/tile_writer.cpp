#include "build/tile_writer.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "build/fill.h"
#include "build/quantiser.h"
#include "illum/picture_io.h"

namespace illum {
namespace {

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

}  // namespace

void TileWriter::write(const PlaneRow& row) {
  // Nested parallelism inside a coder would let more than `atOnce` tiles live.
  tbb::task_arena arena(atOnce_);
  arena.execute([&] {
    tbb::parallel_for(
        0, manifest_.tilesAcross(row.level),
        [&](int x) {
          writeTile(row, x);
          if (manifest_.mask) writeMask(row, x);
          progress_.advance();
        },
        tbb::simple_partitioner());
  });
}

void TileWriter::writeTile(const PlaneRow& row, int x) {
  const std::string name = planeTileName(manifest_, 0, row.level, x, row.row);
  if (writer_.has(name)) return;
  const Rectangle tile = manifest_.tileRectangle(row.level, x, row.row);
  auto planes = cut(row.values, row.size, tile);
  if (manifest_.mask) fillHidden(planes, cut(row.coverage, row.size, tile), tile.size());
  std::uint64_t clipped = 0;
  const auto codes = quantise(manifest_.coding, planes, tile.size(), clipped);
  clipped_ += clipped;
  writer_.add(name, encodeTile(codes, manifest_.coding.coding, manifest_.coding.bits, settings_));
}

void TileWriter::writeMask(const PlaneRow& row, int x) {
  const std::string name = maskTileName(manifest_, 0, row.level, x, row.row);
  if (writer_.has(name)) return;
  const Rectangle tile = manifest_.tileRectangle(row.level, x, row.row);
  const auto coverage = cut(row.coverage, row.size, tile);
  BytePicture picture(tile.size(), 1);
  std::transform(coverage.begin(), coverage.end(), picture.samples().begin(), byteFromUnit);
  writer_.add(name, encodePng(picture));
}

std::uint64_t tileCodingBytes(const Manifest& manifest, int basisPlanes) {
  const auto pixels = static_cast<std::uint64_t>(std::min(manifest.tile, manifest.size.width)) *
                      static_cast<std::uint64_t>(std::min(manifest.tile, manifest.size.height));
  const auto stored = static_cast<std::uint64_t>(manifest.planes());
  // Planes cut out as floats, codes, and libaom's frames and side data. The 24 bytes a sample are
  // an estimate that the tests of --max-memory hold, not a measurement of libaom.
  return pixels * (4 * static_cast<std::uint64_t>(basisPlanes) + (2 + 24) * stored);
}

}  // namespace illum
