// Decoded planes of a tile as relighting reads them: no wider than their codes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/tile.h"

namespace illum {

/// Codes of up to 8 bits lie in bytes, others in words; plane after plane, each row by row.
class TilePlanes {
 public:
  TilePlanes() = default;
  TilePlanes(const PlaneCodes& codes, int bits) : tile_(codes.tile) {
    if (bits <= 8)
      bytes_.assign(codes.values.begin(), codes.values.end());
    else
      words_ = codes.values;
  }

  Size tile() const { return tile_; }
  bool inBytes() const { return !bytes_.empty(); }
  const std::uint8_t* bytes() const { return bytes_.data(); }
  const std::uint16_t* words() const { return words_.data(); }
  std::uint16_t code(std::size_t plane, std::size_t texel) const {
    const std::size_t at = plane * tile_.pixels() + texel;
    return inBytes() ? bytes_[at] : words_[at];
  }
  std::size_t memoryBytes() const { return bytes_.size() + words_.size() * sizeof(std::uint16_t); }

 private:
  Size tile_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> words_;
};

}  // namespace illum
