// The product that makes planes of samples, for the instruction set of the machine.
#pragma once

#include <cstddef>

namespace illum {

/// planes x inner, row-major, and what is added to each row.
struct PlaneProduct {
  const float* matrix = nullptr;
  const float* offset = nullptr;
  std::size_t planes = 0, inner = 0;
};

/// out[k * pixels + p] = offset[k] + sum_i matrix[k * inner + i] * samples[i * pixels + p], each
/// sum in the order of i, so that a pixel's value does not depend on how many others there are or
/// where among them it stands. A library's sgemm does not promise that: its remainders are summed
/// otherwise on some processors.
void sumPlanes(const PlaneProduct& product, const float* samples, std::size_t pixels, float* out);

}  // namespace illum
