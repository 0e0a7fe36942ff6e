// The bytes of one table in basis.bin, version 1. All integers are little-endian.
//
//   offset  type  field
//        0  u8x4  "ILBT"
//        4  u8    version: 1
//        5  u8    domain: 0 hemisphere (one square), 1 sphere (two squares)
//        6  u16   N, the resolution: 4 … 1025
//        8  u32   columns: at least 1; squares * columns * (N+2)^2 is at most 2^24
//       12  u8    B, bytes per code: 1 … 4
//       13  u8x3  0
//       16  u32   bytes of the deflated payload, which is all that follows
//       20        the payload, as a zlib stream (RFC 1950)
//
// The payload has 5 bytes a column and B bytes a code, and begins with five arrays of one byte a
// column: low bytes of s, high bytes of s, low bytes of w, high bytes of w, and r.
//   s  u16, at most 2047: the column's unit is (16 + (s & 15)) * 2^((s >> 4) - 96)
//   w  i16: w / 1024 is how much of an earlier column this one contains
//   r  u8: that column is r columns before this one; 0 if there is none (then w is 0)
// Then the codes follow as B arrays of one byte a code, the most significant bytes first. A code is
// a zig-zag integer: 0, -1, 1, -2, 2, … are stored as 0, 1, 2, 3, 4, …
//
// Codes: for a hemisphere, first one a column for the south pole. Then for every level from the
// coarsest on, for every column, for every square, the level's samples in the order of CodingOrder
// (basis/field_coding.h); only samples that interpolation can reach have codes (basis/chart.h), the
// others are 0. A column's field is made of 32-bit integers in this order:
//   field = prediction (field_coding.h) + code * unitsPerCode(level)
// with unitsPerCode = 16, 8, 4, 2 for the strides 1, 2, 4, 8 and 1 for all larger ones; no
// magnitude is above 2^26. The value of a sample in double precision, then rounded once to single,
// is
//   value = field * unit + w / 1024 * (value of the same sample in the column r before)
// The south pole's field is code * 16 plus the mean (sum + 2) >> 2 of the field at the four samples
// (row, column) = (1, M), (M, 1), (M, N), (N, M), M = (N + 1) / 2 rounded down; its value is made
// alike. Every value is finite.
//
// Why so: columns are smooth, so that interpolation from a coarser grid predicts all but the coarse
// levels to within a step; a code of 0 then costs almost nothing after deflating. Coarser levels
// have finer steps, because finer ones are predicted from them. The channels of a learned basis are
// nearly multiples of one another, which w removes. docs/math/bases.md has the figures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "basis/field_coding.h"
#include "illum/basis_table.h"

namespace illum::basisfile {

inline constexpr std::size_t kHeaderBytes = 20;
inline constexpr std::size_t kColumnBytes = 5;
inline constexpr int kMinResolution = 4, kMaxResolution = 1025;
inline constexpr std::uint64_t kMaxValues = 1 << 24;
inline constexpr int kMaxUnitCode = 2047;
inline constexpr double kWeightScale = 1024;
/// Deflate's best ratio (zlib's technical notes); more is promised by hostile headers only.
inline constexpr std::uint64_t kMaxDeflateRatio = 1032;

/// What the header says, apart from what is always the same.
struct Header {
  LightDomain domain = LightDomain::Hemisphere;
  int resolution = 0;
  std::uint32_t columns = 0;
  int bytesPerCode = 1;
  std::uint32_t payloadBytes = 0;  ///< deflated

  int squares() const { return domain == LightDomain::Sphere ? 2 : 1; }
  int polesPerColumn() const { return domain == LightDomain::Sphere ? 0 : 1; }
};

/// How one column becomes values.
struct ColumnScale {
  std::uint16_t unitCode = 0;
  std::int16_t weightCode = 0;
  std::uint8_t referenceDistance = 0;

  double unit() const;
  double weight() const { return weightCode / kWeightScale; }
};

/// The value of a field sample before it is rounded to single precision; `reference` is the earlier
/// column's value, or 0. Both products are exact, so contraction to a fused operation changes
/// nothing.
inline double valueOf(std::int32_t field, double unit, double weight, float reference) {
  return field * unit + weight * reference;
}

/// The south pole's field without its code.
std::int32_t predictPole(std::span<const std::int32_t> field, int resolution);
inline constexpr std::int32_t kPoleUnitsPerCode = 16;

/// Where each code lies in the sequence of all codes.
class CodeLayout {
 public:
  explicit CodeLayout(const Header& header);

  struct Level {
    std::size_t first, last;  ///< half-open range of CodingOrder::steps
  };
  const CodingOrder& order() const { return order_; }
  const std::vector<Level>& levels() const { return levels_; }
  std::size_t codes() const;
  std::size_t poleIndex(std::size_t column) const { return column; }
  /// Of the level's first sample; its others follow.
  std::size_t levelIndex(const Level& level, std::size_t column, int square) const;

 private:
  std::size_t columns_, squares_, poles_;
  CodingOrder order_;
  std::vector<Level> levels_;
};

}  // namespace illum::basisfile
