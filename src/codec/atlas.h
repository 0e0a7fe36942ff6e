// Walking the cells of an atlas, whatever the picture's own order of samples is.
#pragma once

#include <array>
#include <cstddef>

#include "codec/tile.h"

namespace illum {

/// An atlas picture of 8- or 16-bit samples in memory, interleaved or planar. Channels 0, 1, 2 are
/// red, green, blue.
template <typename Sample>
struct AtlasView {
  std::array<Sample*, 3> channels{};       ///< first sample of each
  std::array<std::size_t, 3> rowStride{};  ///< samples from row to row
  std::size_t step = 1;                    ///< samples from one pixel to the next

  Sample* at(int channel, int x, int y) const {
    const auto c = static_cast<std::size_t>(channel);
    return channels[c] + static_cast<std::size_t>(y) * rowStride[c] +
           static_cast<std::size_t>(x) * step;
  }
};

/// Of an interleaved RGB picture.
template <typename Sample>
AtlasView<Sample> interleavedAtlas(Sample* samples, Size atlas) {
  const std::size_t stride = 3 * static_cast<std::size_t>(atlas.width);
  return {{samples, samples + 1, samples + 2}, {stride, stride, stride}, 3};
}

struct CellOrigin {
  int x = 0, y = 0;
};

inline CellOrigin cellOrigin(const AtlasLayout& layout, int cell) {
  return {cell % layout.columns * layout.cell.width, cell / layout.columns * layout.cell.height};
}

/// Cells that one set of planes takes; with split values the low bytes begin this many cells later.
inline int cellsPerSet(int planes) {
  return (planes + 2) / 3;
}

}  // namespace illum
