// Tiles as some writer of format 1.0 made them, kept as bytes: what they decode to never changes.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "codec/tile.h"

namespace illum {

struct FrozenTile {
  Coding coding;
  int bits;
  std::string_view hex;       ///< the file
  std::vector<int> expected;  ///< codes of 4 planes of 5x3 texels
};

std::vector<FrozenTile> frozenTiles();
std::vector<std::byte> bytesOf(const FrozenTile& tile);

inline constexpr int kFrozenPlanes = 4;
inline constexpr Size kFrozenSize{5, 3};

}  // namespace illum
