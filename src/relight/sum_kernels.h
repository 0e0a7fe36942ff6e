// Kernels of weighted_sum.cpp, for the instruction set of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace illum {

/// A stored plane and its part in `Sums` sums.
template <std::size_t Sums>
struct WeightedPlane {
  std::uint32_t plane = 0;
  float offset = 0;  ///< of the signed square root
  std::array<float, Sums> weight{};
};

/// What a code is to its plane.
enum class CodeMeaning { Number, SignedSqrt, Half };

/// Where codes lie: `first` points at a texel of plane 0, the same texel of plane p is p * stride
/// codes later. One of the two pointers is null.
struct CodeRows {
  const std::uint8_t* bytes = nullptr;
  const std::uint16_t* words = nullptr;
  std::size_t stride = 0;
  CodeMeaning meaning = CodeMeaning::Number;
  float step = 1;  ///< of the signed square root
};

/// Texels that a call of the sums may ask for.
inline constexpr std::size_t kSumBlock = 1024;
/// Room for a block's sum; what lies beyond the texels asked for is undefined.
using SumBlock = std::array<float, kSumBlock>;

/// sums[c][i] = start[c] + sum_p weight_p[c] * v_p(i) for `count` texels, at most kSumBlock. The
/// blocks are aligned to 64 bytes.
void sumWeighted(const CodeRows& codes, std::span<const WeightedPlane<3>> planes, std::size_t count,
                 const std::array<float, 3>& start, const std::array<SumBlock*, 3>& sums);
void sumWeighted(const CodeRows& codes, std::span<const WeightedPlane<1>> planes, std::size_t count,
                 float start, SumBlock& sum);

/// rgb[3 * i + c] = sums[c][i].
void interleave(const std::array<SumBlock*, 3>& sums, std::size_t count, float* rgb);
/// rgb[3 * i + c] = constant[c] + sum_k colours[k][c] * sums[k][i].
void interleaveColoured(const std::array<SumBlock*, 3>& sums,
                        const std::array<std::array<float, 3>, 3>& colours,
                        const std::array<float, 3>& constant, std::size_t count, float* rgb);

}  // namespace illum
