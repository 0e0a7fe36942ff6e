// One decoder per coding. All take untrusted files: the picture's size and kind are held against
// the layout before pixels are decoded or memory for them is taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "codec/tile.h"

namespace illum {

/// A PNG with 8-bit samples, not interlaced, of exactly `size` and 1 (grey) or 3 (RGB) channels:
/// interleaved samples as they stand in the file. Throws Error that begins with `source`.
std::vector<std::uint8_t> decodePngSamples(std::span<const std::byte> file, Size size, int channels,
                                           const std::string& source);

/// A baseline JPEG that stores RGB at full resolution: interleaved samples.
std::vector<std::uint8_t> decodeJpegSamples(std::span<const std::byte> file, Size size,
                                            const std::string& source);

/// An AVIF still of `bits` bits, 4:4:4, full range, identity matrix, no alpha. The values of
/// `codes` are filled through `layout`.
void decodeAvifCodes(std::span<const std::byte> file, int bits, const AtlasLayout& layout,
                     PlaneCodes& codes, const std::string& source);

}  // namespace illum
