// Writing tiles: the counterpart of codec/tile.h.
#pragma once

#include <cstddef>
#include <vector>

#include "codec/tile.h"

namespace illum {

struct EncodeSettings {
  int quality = 75;  ///< 0-100; without meaning for PNG, which is lossless
  int speed = 6;     ///< AVIF only: libaom's 0 (slow) to 10
};

/// The tile's file. Deterministic: the same codes give the same bytes on any number of threads.
std::vector<std::byte> encodeTile(const PlaneCodes& codes, Coding coding, int bits,
                                  const EncodeSettings& settings);

}  // namespace illum
