// From samples that are bytes to planes, without making floats of them first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fit/fit.h"

namespace illum {

/// A PlaneOperator of samples b / 255. Its weights are whole numbers of 16 bits, a scale for each
/// plane, and sums are exact: the same on every machine. Rounding the weights changes a plane by a
/// fortieth of what rounding the photographs to bytes has changed it.
class BytePlanes {
 public:
  /// `planes` must have a matrix, not picks.
  explicit BytePlanes(const PlaneOperator& planes);

  /// As PlaneOperator::apply; samples[(3 * l + c) * pixels + p]. One thread; call it from tasks.
  void apply(std::span<const std::uint8_t> samples, std::size_t pixels,
             std::span<float> planes) const;

 private:
  std::size_t planes_, inner_;
  std::vector<std::int32_t> weights_;  ///< planes x pairs: two of 16 bits, the first one lower
  std::vector<float> scale_, offset_;
};

}  // namespace illum
