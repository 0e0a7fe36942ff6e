// Numbers that look random and are the same everywhere: the standard library's distributions differ
// between implementations.
#pragma once

#include <cstdint>
#include <random>

namespace illum {

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high), evenly.
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace illum
