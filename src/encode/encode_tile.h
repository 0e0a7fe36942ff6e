// Writing tiles: the counterpart of codec/tile.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/tile.h"
#include "illum/picture.h"

namespace illum {

struct EncodeSettings {
  int quality = 75;  ///< 0-100; without meaning for PNG, which is lossless
  int speed = 6;     ///< AVIF only: libaom's 0 (slow) to 10
};

/// The tile's file. Deterministic: the same codes give the same bytes on any number of threads.
/// Codes must lie in [0, 2^bits - 1]. Throws Error (Fault::Usage) for a coding that cannot hold
/// `bits`, and for settings out of range.
std::vector<std::byte> encodeTile(const PlaneCodes& codes, Coding coding, int bits,
                                  const EncodeSettings& settings);

/// A mask's tile: 1 channel of coverage as a grey PNG.
std::vector<std::byte> encodeMaskTile(const BytePicture& coverage);

/// A depth's tile: codes of 0 ... `steps` and kNoDepth, row by row (codec/depth_tile.h).
std::vector<std::byte> encodeDepthTile(std::span<const std::uint16_t> codes, Size tile, int steps);

/// The step of the flat quantisation table of JPEG tiles: 2^((100 - quality) / 12.5), rounded, at
/// most 255. So 100 gives 1, 75 gives 4, 50 gives 16, 25 gives 64.
int jpegStep(int quality);

/// AV1's quantiser index on libaom's short scale, 63 (quality 0) to 0 (quality 100: lossless).
int avifQuantizer(int quality);

}  // namespace illum
