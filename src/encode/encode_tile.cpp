#include "encode/encode_tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "codec/depth_tile.h"
#include "encode/tile_encoders.h"
#include "illum/error.h"

namespace illum {
namespace {

void checkRequest(Coding coding, int bits, const EncodeSettings& settings) {
  if (!supportsBits(coding, bits))
    throw Error(Fault::Usage,
                fmt::format("the coding {} cannot hold {} bits", nameOf(coding), bits));
  if (settings.quality < 0 || settings.quality > 100)
    throw Error(Fault::Usage,
                fmt::format("expected a quality from 0 to 100, found {}", settings.quality));
  if (settings.speed < 0 || settings.speed > 10)
    throw Error(Fault::Usage,
                fmt::format("expected a speed from 0 to 10, found {}", settings.speed));
}

}  // namespace

std::vector<std::byte> encodeTile(const PlaneCodes& codes, Coding coding, int bits,
                                  const EncodeSettings& settings) {
  checkRequest(coding, bits, settings);
  assert(codes.values.size() == static_cast<std::size_t>(codes.planes) * codes.tile.pixels());
  assert(std::all_of(codes.values.begin(), codes.values.end(),
                     [=](std::uint16_t value) { return value >> bits == 0; }));
  const auto layout = AtlasLayout::forTile(codes.planes, codes.tile, splitsBytes(coding, bits));
  if (coding == Coding::Avif) return encodeAvifCodes(codes, bits, layout, settings);

  constexpr std::uint8_t kMiddle = 128;
  std::vector<std::uint8_t> samples(3 * layout.atlas().pixels());
  fillAtlas(interleavedAtlas(samples.data(), layout.atlas()), layout, codes, kMiddle);
  return coding == Coding::Png
             ? encodePngSamples(samples, layout.atlas(), 3)
             : encodeJpegSamples(samples, layout.atlas(), jpegStep(settings.quality));
}

std::vector<std::byte> encodeMaskTile(const BytePicture& coverage) {
  assert(coverage.channels() == 1);
  return encodePngSamples(coverage.samples(), coverage.size(), 1);
}

std::vector<std::byte> encodeDepthTile(std::span<const std::uint16_t> codes, Size tile, int steps) {
  assert(codes.size() == tile.pixels());
  assert(std::all_of(codes.begin(), codes.end(),
                     [=](std::uint16_t code) { return code <= steps || code == kNoDepth; }));
  std::vector<std::uint8_t> samples;
  if (fitsGreyDepth(steps)) {
    for (const std::uint16_t code : codes) samples.push_back(static_cast<std::uint8_t>(code));
    return encodePngSamples(samples, tile, 1);
  }
  for (const std::uint16_t code : codes)
    samples.insert(samples.end(), {static_cast<std::uint8_t>(code >> 8),
                                   static_cast<std::uint8_t>(code & 255), std::uint8_t{0}});
  return encodePngSamples(samples, tile, 3);
}

int jpegStep(int quality) {
  return std::min(255, static_cast<int>(std::lround(std::exp2((100 - quality) / 12.5))));
}

int avifQuantizer(int quality) {
  return static_cast<int>(std::lround(63 * (100 - quality) / 100.0));
}

}  // namespace illum
