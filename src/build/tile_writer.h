// The last steps of building: a row of fitted planes becomes coded tiles, and one of them the
// poster.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

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

class TileWriter {
 public:
  /// `atOnce`: tiles coded side by side, which bounds memory. `progress` advances by the pixels of
  /// level 0 that are coded.
  TileWriter(const Manifest& manifest, const EncodeSettings& settings, int atOnce,
             ObjectWriter& writer, Progress& progress)
      : manifest_(manifest),
        settings_(settings),
        atOnce_(atOnce),
        writer_(writer),
        progress_(progress) {}

  /// Quantises, codes and adds the row's tiles that the writer does not have yet.
  void write(const PlaneRow& row);

  SampleCounts samples() const { return {samples_, clipped_}; }

 private:
  void writeTile(const PlaneRow& row, int x);
  void writeMask(const PlaneRow& row, int x);
  void writeDepth(const PlaneRow& row, int x);

  const Manifest& manifest_;
  EncodeSettings settings_;
  int atOnce_;
  ObjectWriter& writer_;
  Progress& progress_;
  std::atomic<std::uint64_t> samples_ = 0, clipped_ = 0;
};

/// Bytes that coding the largest tile of any group takes beside the row itself, an estimate.
/// `planesOfBases`: of each basis of the manifest.
std::uint64_t tileCodingBytes(const Manifest& manifest, std::span<const int> planesOfBases);

}  // namespace illum
