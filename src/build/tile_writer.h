// The last steps of building: a row of fitted planes becomes coded tiles, and one of them the
// poster.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "build/plane_row.h"
#include "encode/encode_tile.h"
#include "encode/object_writer.h"
#include "illum/progress.h"
#include "object/manifest.h"

namespace illum {

/// Of planes, as they became codes: how many there were, and how many lay outside the quantiser's
/// range.
struct SampleCounts {
  std::uint64_t all = 0, clipped = 0;
};

/// One tile of a row, its values its own.
struct CutTile {
  int group = 0, level = 0, x = 0, y = 0;  ///< x and y in tiles
  std::vector<float> planes, coverage, depth;
};

class TileWriter {
 public:
  /// `progress` advances by the pixels of level 0 that are coded.
  TileWriter(const Manifest& manifest, const EncodeSettings& settings, ObjectWriter& writer,
             Progress& progress)
      : manifest_(manifest), settings_(settings), writer_(writer), progress_(progress) {}

  CutTile cut(const PlaneRow& row, int x) const;
  /// Quantises, codes and adds what the writer does not have yet of the tile, its mask and its
  /// depth. Thread safe.
  void write(CutTile tile);

  SampleCounts samples() const { return {samples_, clipped_}; }

 private:
  Size sizeOfTile(const CutTile& tile) const {
    return manifest_.grid(tile.group).tileRectangle(tile.level, tile.x, tile.y).size();
  }
  void writePlanes(CutTile& tile);
  void writeMask(const CutTile& tile);
  void writeDepth(const CutTile& tile);

  const Manifest& manifest_;
  EncodeSettings settings_;
  ObjectWriter& writer_;
  Progress& progress_;
  std::atomic<std::uint64_t> samples_ = 0, clipped_ = 0;
};

/// The tiles of rows, each cut when it is asked for: its row must stay until then.
class TileQueue {
 public:
  explicit TileQueue(const Manifest& manifest) : manifest_(manifest) {}
  void add(const PlaneRow& row);
  bool empty() const { return places_.empty(); }
  CutTile next(const TileWriter& writer);

 private:
  const Manifest& manifest_;
  std::deque<std::pair<const PlaneRow*, int>> places_;
};

/// Writes tiles, at most `atOnce` side by side, while `next` makes more, one call at a time, until
/// it gives none.
void writeTiles(TileWriter& writer, int atOnce,
                const std::function<std::optional<CutTile>()>& next);

/// Bytes that coding the largest tile of any group takes beside the row itself, an estimate.
/// `planesOfBases`: of each basis of the manifest.
std::uint64_t tileCodingBytes(const Manifest& manifest, std::span<const int> planesOfBases);

}  // namespace illum
