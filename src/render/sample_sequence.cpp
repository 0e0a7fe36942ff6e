#include "render/sample_sequence.h"

namespace illum {
namespace {

// A finaliser of 64 bits (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number
// generators").
std::uint64_t mixed(std::uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9u;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint32_t reversed(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

// Owen's scrambling of reversed bits by a hash whose every bit depends on lower ones only (Laine
// and Karras 2011; constants of Burley 2020, "Practical hash-based Owen scrambling").
std::uint32_t scrambledReversed(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  return reversed(scrambledReversed(reversed(x), seed));
}

// The second dimension of Sobol's sequence; the first is the reversed index.
std::uint32_t sobolSecond(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t column = 0x80000000u; index != 0; index >>= 1, column ^= column >> 1) {
    if (index & 1u) result ^= column;
  }
  return result;
}

float unitFromBits(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace

SampleSequence::SampleSequence(std::uint64_t seed, int x, int y, int sample)
    : sample_(static_cast<std::uint32_t>(sample)) {
  const auto position = static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 |
                        static_cast<std::uint32_t>(y);
  pixel_ = static_cast<std::uint32_t>(mixed(mixed(seed + 0x9e3779b97f4a7c15u) ^ position));
}

std::array<float, 2> SampleSequence::pair(std::uint32_t dimension) const {
  const std::uint64_t keys =
      mixed(static_cast<std::uint64_t>(pixel_) << 32 | (dimension + 0x9e3779b9u));
  const std::uint64_t more = mixed(keys);
  // Shuffling the samples makes dimensions independent of each other.
  const std::uint32_t index = scrambled(sample_, static_cast<std::uint32_t>(keys));
  const std::uint32_t first = scrambledReversed(index, static_cast<std::uint32_t>(keys >> 32));
  const std::uint32_t second = scrambled(sobolSecond(index), static_cast<std::uint32_t>(more));
  return {unitFromBits(reversed(first)), unitFromBits(second)};
}

}  // namespace illum
