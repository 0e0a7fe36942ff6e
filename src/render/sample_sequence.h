// The random numbers of rendering: a function of seed, pixel, sample and dimension, so that a value
// depends on neither threads, order nor what else is rendered.
#pragma once

#include <array>
#include <cstdint>

namespace illum {

/// The numbers of one sample of one pixel. Over the samples of a pixel every dimension is a (0, 2)
/// sequence with Owen's scrambling: 4 or 16 samples are stratified in the square. Dimensions and
/// pixels are independent of each other.
class SampleSequence {
 public:
  SampleSequence(std::uint64_t seed, int x, int y, int sample);

  /// Two numbers in [0, 1).
  std::array<float, 2> pair(std::uint32_t dimension) const;

 private:
  std::uint32_t pixel_;
  std::uint32_t sample_;
};

}  // namespace illum
