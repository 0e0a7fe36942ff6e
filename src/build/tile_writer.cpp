#include "build/tile_writer.h"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

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
std::vector<float> cutOut(std::span<const float> values, Size row, const Rectangle& tile) {
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

CutTile TileWriter::cut(const PlaneRow& row, int x) const {
  CutTile tile{row.group, row.level, x, row.row, {}, {}, {}};
  const Rectangle place = manifest_.grid(row.group).tileRectangle(row.level, x, row.row);
  tile.planes = cutOut(row.values, row.size, place);
  if (manifest_.mask) tile.coverage = cutOut(row.coverage, row.size, place);
  if (!row.depth.empty()) tile.depth = cutOut(row.depth, row.size, place);
  return tile;
}

void TileWriter::write(CutTile tile) {
  writePlanes(tile);
  if (manifest_.mask) writeMask(tile);
  if (!tile.depth.empty()) writeDepth(tile);
  if (tile.level > 0) return;
  progress_.advance(manifest_.grid(tile.group).tileRectangle(0, tile.x, tile.y).pixels());
}

void TileWriter::writePlanes(CutTile& tile) {
  const std::string name = planeTileName(manifest_, tile.group, tile.level, tile.x, tile.y);
  if (writer_.has(name)) return;
  const Size size = sizeOfTile(tile);
  if (manifest_.mask) fillHidden(tile.planes, tile.coverage, size);
  std::uint64_t clipped = 0;
  const CodingEntry& coding = manifest_.coding(tile.group);
  const auto codes = quantise(coding, tile.planes, size, clipped);
  samples_ += tile.planes.size();
  clipped_ += clipped;
  writer_.add(name, encodeTile(codes, coding.coding, coding.bits, settings_));
}

void TileWriter::writeMask(const CutTile& tile) {
  const std::string name = maskTileName(manifest_, tile.group, tile.level, tile.x, tile.y);
  if (writer_.has(name)) return;
  BytePicture picture(sizeOfTile(tile), 1);
  std::ranges::transform(tile.coverage, picture.samples().begin(), byteFromUnit);
  writer_.add(name, encodeMaskTile(picture));
}

void TileWriter::writeDepth(const CutTile& tile) {
  const std::string name = depthTileName(manifest_, tile.group, tile.level, tile.x, tile.y);
  if (writer_.has(name)) return;
  const DepthRange& range = *manifest_.groups[static_cast<std::size_t>(tile.group)].depth;
  std::vector<std::uint16_t> codes;
  for (const float depth : tile.depth) codes.push_back(codeOf(range, depth));
  writer_.add(name, encodeDepthTile(codes, sizeOfTile(tile), range.steps));
}

void TileQueue::add(const PlaneRow& row) {
  for (int x = 0; x < manifest_.grid(row.group).tilesAcross(row.level); ++x)
    places_.emplace_back(&row, x);
}

CutTile TileQueue::next(const TileWriter& writer) {
  const auto [row, x] = places_.front();
  places_.pop_front();
  return writer.cut(*row, x);
}

void writeTiles(TileWriter& writer, int atOnce,
                const std::function<std::optional<CutTile>()>& next) {
  using Token = std::shared_ptr<CutTile>;
  tbb::parallel_pipeline(
      static_cast<std::size_t>(atOnce),
      tbb::make_filter<void, Token>(tbb::filter_mode::serial_in_order,
                                    [&](tbb::flow_control& flow) -> Token {
                                      std::optional<CutTile> tile = next();
                                      if (tile) return std::make_shared<CutTile>(std::move(*tile));
                                      flow.stop();
                                      return nullptr;
                                    }) &
          tbb::make_filter<Token, void>(tbb::filter_mode::parallel, [&](const Token& tile) {
            writer.write(std::move(*tile));
          }));
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
