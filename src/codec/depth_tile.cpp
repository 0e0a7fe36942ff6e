#include "codec/depth_tile.h"

#include <fmt/format.h>

#include "codec/tile_decoders.h"
#include "illum/error.h"

namespace illum {

std::vector<std::uint16_t> decodeDepthTile(Size tile, int steps, std::span<const std::byte> file,
                                           const std::string& source) {
  const bool grey = fitsGreyDepth(steps);
  const auto samples = decodePngSamples(file, tile, grey ? 1 : 3, source);
  std::vector<std::uint16_t> codes(tile.pixels());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const int code = grey ? samples[i] : samples[3 * i] << 8 | samples[3 * i + 1];
    const bool nothing = code == (grey ? 255 : kNoDepth);
    if (!nothing && code > steps)
      throw Error(Fault::Input,
                  fmt::format("{}: expected depth codes up to {}, found {}", source, steps, code));
    codes[i] = nothing ? kNoDepth : static_cast<std::uint16_t>(code);
  }
  return codes;
}

}  // namespace illum
