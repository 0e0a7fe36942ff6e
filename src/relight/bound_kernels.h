// What the machine can do at most, for benchmarks: with the same instructions as the kernels.
#pragma once

#include <cstddef>
#include <span>

namespace illum {

/// Reads all bytes and writes all floats, side by side as a sum of planes does, and does as little
/// as it can with them.
float readAndWrite(const void* codes, std::size_t bytes, std::span<float> picture);

/// At least `count` multiplications with an addition each, in registers.
float multiplyAndAdd(std::size_t count);

}  // namespace illum
