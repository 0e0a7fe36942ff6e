// Interpolating prediction of a chart square's samples (docs/format.md, "basis.bin", "Codes").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace illum {

/// Where a sample's prediction comes from: the first of these (after None) whose samples all exist
/// and are known. v[-d] is the nearest known sample along the axis on the side toward the grid's
/// centre, v[+d] the one opposite. Divisions round to nearest, halves up: (a + 2^(n-1)) >> n.
enum class Prediction : std::uint8_t {
  None,                  ///< 0, for the grid's centre
  Cubic,                 ///< (9 v[-d] + 9 v[+d] - v[-3d] - v[+3d]) / 16
  OneSided,              ///< (6 v[-d] + 3 v[+d] - v[-3d]) / 8
  Linear,                ///< (v[-d] + v[+d]) / 2
  ExtrapolateQuadratic,  ///< (15 v[-d] - 10 v[-3d] + 3 v[-5d]) / 8
  ExtrapolateLinear,     ///< (3 v[-d] - v[-3d]) / 2
  Nearest,               ///< v[-d]
};

/// One sample in coding order.
struct CodingStep {
  std::uint32_t sample;  ///< row * side + column
  std::int32_t d;        ///< in samples: +-stride along the row, +-stride * side along the column
  Prediction prediction;
  std::uint8_t level;  ///< log2 of the stride
};

/// Values are integers of at most this magnitude, so that predictions fit 32 bits.
inline constexpr std::int32_t kMaxFieldValue = 1 << 26;

/// The order in which a square's reachable samples are coded. The grid's centre is row and column
/// side / 2 (rounded down) and comes first. Then for strides 2^n, …, 4, 2, 1 (2^n: the largest that
/// is at most side / 2) two passes: samples that are an odd multiple of the stride from the centre
/// along the row and an even one along the column, predicted along the row; then those that are any
/// multiple along the row and an odd one along the column, predicted along the column. Each pass
/// runs by rows, then by columns.
struct CodingOrder {
  explicit CodingOrder(int resolution);
  std::vector<CodingStep> steps;
};

/// The prediction of one sample from those before it in the order.
std::int32_t predict(const CodingStep& step, std::span<const std::int32_t> field);

/// How many units a code of this level counts.
std::int32_t unitsPerCode(int level);

}  // namespace illum
