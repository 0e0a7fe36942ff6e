// Coding one column of a table within an error (basis/basis_file.h has the format).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "basis/basis_file.h"
#include "basis/field_coding.h"
#include "illum/basis_table.h"

namespace illum::basisfile {

/// What all columns of a table have in common.
struct TableShape {
  explicit TableShape(const BasisTable& table);

  /// Root mean square of a column's samples (square by square) that lie in the discs.
  double rmsOverDisc(std::span<const float> values) const;

  int resolution, squares;
  std::size_t samples;               ///< of one square
  std::size_t discSamples = 0;       ///< of one square
  std::vector<std::uint8_t> inDisc;  ///< vertices that the square's own hemisphere charts to
  CodingOrder order;
};

/// One way to code a column.
struct CodedColumn {
  ColumnScale scale;
  std::vector<std::int32_t> codes;  ///< square by square in coding order, then the pole's
  std::vector<float> values;        ///< what decoding gives, square by square
  float pole = 0;
  double rmsError = 0;                                    ///< over the discs
  double cost = std::numeric_limits<double>::infinity();  ///< estimated bits
};

/// Codes one column. `values`: square by square, 0 where interpolation cannot reach; `pole`: null
/// on the sphere. All are kept by reference.
class ColumnCoder {
 public:
  ColumnCoder(const TableShape& shape, std::span<const float> values, const float* pole)
      : shape_(shape), values_(values), pole_(pole), field_(shape.samples) {}

  /// The cheapest coding within `error`, with `reference` (already decoded) `distance` columns
  /// before.
  CodedColumn codeWithin(double error, const CodedColumn* reference, int distance);

 private:
  void setTarget(const CodedColumn* reference, int distance);
  void code(int unitCode, CodedColumn& out);
  double codeSquare(int square, CodedColumn& out);
  void codePole(CodedColumn& out);

  const TableShape& shape_;
  std::span<const float> values_;
  const float* pole_;
  std::vector<std::int32_t> field_;
  const CodedColumn* reference_ = nullptr;
  ColumnScale scale_;
  double largest_ = 0;  ///< magnitude of what is left after the reference
};

}  // namespace illum::basisfile
