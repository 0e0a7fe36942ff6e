// One encoder per coding, each the counterpart of a decoder in codec/tile_decoders.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/atlas.h"
#include "encode/encode_tile.h"

namespace illum {

/// Interleaved 8-bit samples, 1 (grey) or 3 (RGB) channels, as a PNG of nothing but IHDR, IDAT,
/// IEND.
std::vector<std::byte> encodePngSamples(std::span<const std::uint8_t> samples, Size size,
                                        int channels);

/// Interleaved RGB as a baseline JPEG without colour transform or subsampling, quantised by the one
/// `step` (1-255) for all frequencies.
std::vector<std::byte> encodeJpegSamples(std::span<const std::uint8_t> samples, Size size,
                                         int step);

/// Fills `codes` through `layout` into an AVIF still.
std::vector<std::byte> encodeAvifCodes(const PlaneCodes& codes, int bits, const AtlasLayout& layout,
                                       const EncodeSettings& settings);

/// Writes every texel of the atlas: cells padded by replicating their last column and row, channels
/// and cells without a plane filled with `unused`. Value of a sample: code >> shift & mask.
template <typename Sample>
void fillAtlas(const AtlasView<Sample>& view, const AtlasLayout& layout, const PlaneCodes& codes,
               Sample unused) {
  const int sets = layout.split ? 2 : 1;
  for (int cell = 0; cell < layout.columns * layout.rows; ++cell) {
    const int set = cell / cellsPerSet(layout.planes);
    const int firstPlane = cell % cellsPerSet(layout.planes) * 3;
    const CellOrigin origin = cellOrigin(layout, cell);
    const int shift = layout.split && set == 0 ? 8 : 0;
    for (int c = 0; c < 3; ++c) {
      const bool used = set < sets && firstPlane + c < layout.planes;
      for (int y = 0; y < layout.cell.height; ++y) {
        Sample* out = view.at(c, origin.x, origin.y + y);
        const std::uint16_t* row =
            used ? codes.plane(firstPlane + c).data() +
                       static_cast<std::size_t>(std::min(y, layout.tile.height - 1)) *
                           static_cast<std::size_t>(layout.tile.width)
                 : nullptr;
        for (int x = 0; x < layout.cell.width; ++x, out += view.step)
          *out =
              row ? static_cast<Sample>(row[std::min(x, layout.tile.width - 1)] >> shift) : unused;
      }
    }
  }
}

}  // namespace illum
