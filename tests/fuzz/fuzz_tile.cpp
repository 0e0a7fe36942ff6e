// Tiles: the first five bytes say what the manifest would (coding, bits, planes, width, height),
// the rest is the file.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "codec/tile.h"
#include "illum/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 5) return 0;
  constexpr std::array kCodings{illum::Coding::Png, illum::Coding::Avif, illum::Coding::Jpeg};
  constexpr std::array kBits{8, 10, 12, 16};
  const illum::Coding coding = kCodings[data[0] % kCodings.size()];
  const int bits = kBits[data[1] % kBits.size()];
  const int planes = 1 + data[2] % 12;
  const illum::Size tile{1 + data[3] % 64, 1 + data[4] % 64};
  const std::span file(reinterpret_cast<const std::byte*>(data) + 5, size - 5);
  try {
    const auto codes = illum::decodeTile(coding, bits, planes, tile, file, "tile");
    if (codes.values.size() != static_cast<std::size_t>(planes) * tile.pixels()) std::abort();
    for (const auto value : codes.values)
      if (value >> bits != 0) std::abort();
  } catch (const illum::Error&) {
  }
  try {
    illum::decodeMaskTile(tile, file, "mask");
  } catch (const illum::Error&) {
  }
  return 0;
}
