#include "illum/colour.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace illum {
namespace {

// IEC 61966-2-1:1999, section 5.2, for x >= 0. Double inside: two correctly rounded readers agree.
double encodeSrgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decodeSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

int roundedByte(float linear) {
  return static_cast<int>(std::lround(255 * encodeSrgb(linear)));
}

// displayByteFromLinear without a power. The range (2^-13, 1) is cut into buckets by the float's
// exponent and its seven leading mantissa bits; a bucket is so narrow that it holds at most one
// step of the byte (the densest octave, [0.5, 1), has 72 steps and 128 buckets). Below 2^-13 every
// byte is 0: the first step is at 0.5 / 255 / 12.92 = 2^-12.69.
class ByteTable {
 public:
  ByteTable() {
    for (int byte = 1; byte < 256; ++byte) stepTo_[byte] = smallestWithByte(byte);
    stepTo_[0] = 0;
    stepTo_[256] = 2;  // above every bucket
    for (std::uint32_t bucket = 0; bucket < kBuckets; ++bucket) {
      const auto start = std::bit_cast<float>((bucket + kFirstBucket) << kDroppedBits);
      byteAtStart_[bucket] = static_cast<std::uint8_t>(roundedByte(start));
    }
  }

  /// For linear in [2^-13, 1).
  std::uint8_t operator()(float linear) const {
    const std::uint32_t bucket =
        (std::bit_cast<std::uint32_t>(linear) >> kDroppedBits) - kFirstBucket;
    const std::uint8_t byte = byteAtStart_[bucket];
    return static_cast<std::uint8_t>(byte + (linear >= stepTo_[byte + 1U] ? 1 : 0));
  }

  static constexpr float kSmallest = 0x1p-13F;

 private:
  static constexpr int kDroppedBits = 16;
  static constexpr std::uint32_t kFirstBucket =
      std::bit_cast<std::uint32_t>(kSmallest) >> kDroppedBits;
  static constexpr std::uint32_t kBuckets = 13 << 7;

  /// Bisects over the bit patterns, which are ordered like the positive floats they stand for.
  static float smallestWithByte(int byte) {
    auto below = std::bit_cast<std::uint32_t>(0.0F);
    auto reached = std::bit_cast<std::uint32_t>(1.0F);
    while (reached - below > 1) {
      const std::uint32_t middle = below + (reached - below) / 2;
      (roundedByte(std::bit_cast<float>(middle)) < byte ? below : reached) = middle;
    }
    return std::bit_cast<float>(reached);
  }

  std::array<float, 257> stepTo_;  ///< the smallest value that gives this byte
  std::array<std::uint8_t, kBuckets> byteAtStart_;
};

}  // namespace

float displayFromLinear(float linear) {
  return static_cast<float>(std::copysign(encodeSrgb(std::abs(linear)), linear));
}

float linearFromDisplay(float display) {
  return static_cast<float>(std::copysign(decodeSrgb(std::abs(display)), display));
}

std::uint8_t displayByteFromLinear(float linear) {
  static const ByteTable table;
  if (!(linear >= ByteTable::kSmallest)) return 0;  // also NaN
  return linear >= 1 ? 255 : table(linear);
}

std::uint8_t byteFromUnit(float unit) {
  if (!(unit > 0)) return 0;  // also NaN
  return unit >= 1 ? 255 : static_cast<std::uint8_t>(255.0 * unit + 0.5);
}

}  // namespace illum
