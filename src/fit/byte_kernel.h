// The product that makes planes of bytes, for the instruction set of the machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace illum {

/// Of `planes` rows. Weights of two samples, one after the other, are the halves of 32 bits.
struct ByteProduct {
  const std::int32_t* weights = nullptr;  ///< planes x ceil(inner / 2); an odd one's second is 0
  const float* scale = nullptr;
  const float* offset = nullptr;
  std::size_t planes = 0, inner = 0;
};

/// out[k * pixels + p] = offset[k] + scale[k] * sum_i weight[k, i] * samples[i * pixels + p]. The
/// sum is exact; the weights are such that it fits 32 bits whatever the samples.
void sumPlanesOfBytes(const ByteProduct& product, const std::uint8_t* samples, std::size_t pixels,
                      float* out);

}  // namespace illum
