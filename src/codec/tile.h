// One tile of planes as one picture: an atlas of RGB cells, three planes a cell (docs/format.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "illum/picture.h"

namespace illum {

enum class Coding { Png, Avif, Jpeg };
std::string_view nameOf(Coding coding);        ///< "png", "avif", "jpeg"
std::string_view fileSuffixOf(Coding coding);  ///< ".png", ".avif", ".jpg"
/// Throws Error (Fault::Usage) listing the codings.
Coding codingFromName(std::string_view name);

/// Whether `coding` can hold codes of `bits` bits: PNG 8, 10, 12, 16; AVIF 8, 10, 12; JPEG 8.
bool supportsBits(Coding coding, int bits);

/// Longest side of an atlas, in texels.
inline constexpr int kMaxAtlasSide = 4096;
/// Sides of a cell are multiples of this.
inline constexpr int kCellAlignment = 8;
inline constexpr int kMaxPlanes = 768;

/// Where the planes of a tile lie in its picture. Plane k is channel k % 3 of cell k / 3; cells run
/// in rows of `columns`. With more than 8 bits in a coding of 8-bit pictures (PNG) the high bytes'
/// cells come first and the low bytes' cells follow in the same order.
struct AtlasLayout {
  int planes = 0;
  Size tile;  ///< texels of a plane
  Size cell;  ///< tile rounded up to multiples of 8, padded by edge replication
  int columns = 0, rows = 0;
  bool split = false;  ///< 16-bit values as high and low bytes

  /// Of all numbers of columns the one that makes the longer side shortest; of those the smallest.
  /// Throws Error (Fault::Input) when that exceeds kMaxAtlasSide.
  static AtlasLayout forTile(int planes, Size tile, bool split);
  Size atlas() const { return {columns * cell.width, rows * cell.height}; }
  int cells() const { return (planes + 2) / 3 * (split ? 2 : 1); }
};

/// Whether `coding` at `bits` stores high and low bytes apart.
bool splitsBytes(Coding coding, int bits);

/// Quantised planes: values[plane * tile.pixels() + y * width + x] in [0, 2^bits - 1].
struct PlaneCodes {
  int planes = 0;
  Size tile;
  std::vector<std::uint16_t> values;
  std::span<std::uint16_t> plane(int k) {
    return {values.data() + static_cast<std::size_t>(k) * tile.pixels(), tile.pixels()};
  }
  std::span<const std::uint16_t> plane(int k) const {
    return {values.data() + static_cast<std::size_t>(k) * tile.pixels(), tile.pixels()};
  }
  friend bool operator==(const PlaneCodes&, const PlaneCodes&) = default;
};

/// Decodes a tile's file. The picture must have exactly the layout's size and depth. Untrusted
/// input is safe; throws Error (Fault::Input) that begins with `source`.
PlaneCodes decodeTile(Coding coding, int bits, int planes, Size tile,
                      std::span<const std::byte> file, const std::string& source);

/// Decodes a mask's tile: coverage, 1 channel. As safe as decodeTile.
BytePicture decodeMaskTile(Size tile, std::span<const std::byte> file, const std::string& source);

}  // namespace illum
