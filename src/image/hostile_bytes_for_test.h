// Damaging files in tests: a decoder must give a picture or an Error, nothing else.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "illum/error.h"

namespace illum {

/// Whether `decode` took the bytes; where it did not, the test fails unless it threw a sentence of
/// Fault::Input that begins with the source's name "hostile".
template <typename Decode>
bool isTaken(std::span<const std::byte> bytes, const Decode& decode) {
  try {
    EXPECT_FALSE(decode(bytes).size() == Size{});
    return true;
  } catch (const Error& error) {
    const std::string sentence = error.what();
    EXPECT_EQ(error.fault(), Fault::Input) << sentence;
    EXPECT_EQ(sentence.rfind("hostile: expected ", 0), 0U) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    return false;
  }
}

/// The lengths, shorter than the whole, that were taken.
template <typename Decode>
std::vector<std::size_t> takenTruncations(std::span<const std::byte> bytes, const Decode& decode) {
  std::vector<std::size_t> taken;
  for (std::size_t length = 0; length < bytes.size(); ++length)
    if (isTaken(bytes.first(length), decode)) taken.push_back(length);
  return taken;
}

/// How many files with one bit flipped were taken.
template <typename Decode>
std::size_t takenBitFlips(std::span<const std::byte> bytes, const Decode& decode) {
  std::size_t taken = 0;
  std::vector<std::byte> damaged(bytes.begin(), bytes.end());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const std::byte mask = std::byte{1} << static_cast<int>(bit % 8);
    damaged[bit / 8] ^= mask;
    taken += isTaken(damaged, decode) ? 1 : 0;
    damaged[bit / 8] ^= mask;
  }
  return taken;
}

}  // namespace illum
