// One tile of depths as a grey or RGB picture (docs/format.md, "Depth").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "illum/picture.h"

namespace illum {

/// The code of a pixel that shows nothing.
inline constexpr std::uint16_t kNoDepth = 65535;
/// The greatest number of steps between the least and the greatest depth.
inline constexpr int kMaxDepthSteps = kNoDepth - 1;

/// Whether codes of 0 ... steps and kNoDepth fit 8 bits: grey, 255 for kNoDepth. Else RGB: high
/// byte, low byte, 0.
constexpr bool fitsGreyDepth(int steps) {
  return steps < 255;
}

/// The tile's codes, row by row. Untrusted input is safe; throws Error (Fault::Input) that begins
/// with `source` for a picture of another size or kind and for codes above `steps`.
std::vector<std::uint16_t> decodeDepthTile(Size tile, int steps, std::span<const std::byte> file,
                                           const std::string& source);

}  // namespace illum
