// From samples as photographs keep them to floats, one row of pixels at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "capture/sample_type.h"
#include "illum/capture.h"
#include "illum/colour.h"

namespace illum {

/// How many bytes RowConverter shares between all its objects.
inline constexpr std::size_t kSharedTableBytes = 65536 * sizeof(float);

/// Turns one photograph's samples into what Capture::read gives. Thread safe.
class RowConverter {
 public:
  /// `channels`: 1 grey, 2 with alpha, 3 RGB, 4 with alpha. `intensity` divides, in linear light.
  RowConverter(SampleType type, int channels, Transfer transfer, LinearRgb intensity);

  /// `count` pixels, the next one `step` bytes on (also backward), into three rows, in the domain
  /// of the transfer. Grey goes to all three.
  void toTransfer(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                  std::span<float* const, 3> rgb) const;

  /// Whether samples are bytes that only change their type.
  bool isPlainBytes() const { return plain_ && type_ == SampleType::Byte; }
  /// The same as toTransfer, as bytes; where isPlainBytes().
  void toBytes(const std::byte* first, std::ptrdiff_t step, std::size_t count,
               std::span<std::uint8_t* const, 3> rgb) const;

  /// The same, always in linear light.
  void toLinear(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                std::span<float* const, 3> rgb) const;

  /// Coverage of `count` pixels in [0, 1]; 1 where there is no alpha.
  void alpha(const std::byte* first, std::ptrdiff_t step, std::size_t count, float* coverage) const;

 private:
  /// Of one sample: colour channel c of 3.
  float linearOf(float unit, std::size_t c) const;
  float linearOf(std::uint8_t byte, std::size_t c) const;
  float linearOf(std::uint16_t word, std::size_t c) const;
  template <typename T, typename Function>
  void each(const std::byte* first, std::ptrdiff_t step, std::size_t count,
            std::span<float* const, 3> rgb, Function function) const;
  template <typename T>
  void toTransferOf(const std::byte* first, std::ptrdiff_t step, std::size_t count,
                    std::span<float* const, 3> rgb) const;

  SampleType type_;
  int channels_;
  Transfer transfer_;
  std::array<float, 3> intensity_;
  bool plain_;  ///< intensity 1: samples only change their type
  std::vector<float> transferOfByte_, linearOfByte_;  ///< [256 * c + byte]; for SampleType::Byte
};

}  // namespace illum
