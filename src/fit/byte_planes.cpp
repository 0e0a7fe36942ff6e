#include "fit/byte_planes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "fit/byte_kernel.h"

namespace illum {
namespace {

constexpr double kWhite = 255;

// What weights are divided by to become whole: none is beyond 16 bits, and no sum of products with
// bytes beyond 32, each weight rounded up. 0 where all are 0.
double unitOf(std::span<const float> weights) {
  double largest = 0, sum = 0;
  for (const float weight : weights) {
    const double size = std::abs(static_cast<double>(weight));
    largest = std::max(largest, size);
    sum += size;
  }
  constexpr double kMostWeight = std::numeric_limits<std::int16_t>::max();
  constexpr double kMostSum = std::numeric_limits<std::int32_t>::max() / kWhite;
  const double rounding = static_cast<double>(weights.size());
  return std::max(largest / kMostWeight, sum / (kMostSum - rounding));
}

std::int32_t paired(std::int32_t first, std::int32_t second) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(first & 0xffff) |
                                   static_cast<std::uint32_t>(second) << 16);
}

}  // namespace

BytePlanes::BytePlanes(const PlaneOperator& planes)
    : planes_(static_cast<std::size_t>(planes.planes)),
      inner_(3 * static_cast<std::size_t>(planes.lights)),
      offset_(planes.offset) {
  assert(planes.matrix.size() == planes_ * inner_ && offset_.size() == planes_);
  for (std::size_t k = 0; k < planes_; ++k) {
    const auto row = std::span(planes.matrix).subspan(k * inner_, inner_);
    const double unit = unitOf(row);
    scale_.push_back(static_cast<float>(unit / kWhite));
    const auto whole = [&](std::size_t i) {
      return i < inner_ && unit > 0
                 ? static_cast<std::int32_t>(std::lround(static_cast<double>(row[i]) / unit))
                 : 0;
    };
    for (std::size_t i = 0; i < inner_; i += 2) weights_.push_back(paired(whole(i), whole(i + 1)));
  }
}

void BytePlanes::apply(std::span<const std::uint8_t> samples, std::size_t pixels,
                       std::span<float> planes) const {
  assert(samples.size() == inner_ * pixels && planes.size() == planes_ * pixels);
  if (pixels == 0 || planes_ == 0) return;
  sumPlanesOfBytes({weights_.data(), scale_.data(), offset_.data(), planes_, inner_},
                   samples.data(), pixels, planes.data());
}

}  // namespace illum
