#include "capture/exif_orientation.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace illum {
namespace {

// A TIFF structure with two entries, of which the second is the orientation.
std::vector<std::byte> block(bool bigEndian, int orientation) {
  std::vector<std::byte> bytes;
  const auto put = [&](unsigned value, int count) {
    for (int i = 0; i < count; ++i) {
      bytes.push_back(static_cast<std::byte>(value >> 8 * (bigEndian ? count - 1 - i : i)));
    }
  };
  bytes.assign(2, static_cast<std::byte>(bigEndian ? 'M' : 'I'));
  put(42, 2);
  put(8, 4);
  put(2, 2);
  for (const unsigned tag : {0x0110u, 0x0112u}) {
    put(tag, 2);
    put(3, 2);
    put(1, 4);
    put(tag == 0x0112u ? static_cast<unsigned>(orientation) : 4u, 2);
    put(0, 2);
  }
  put(0, 4);
  return bytes;
}

TEST(ExifOrientation, IsFoundInBothByteOrders) {
  for (const bool bigEndian : {false, true}) {
    for (int orientation = 1; orientation <= 8; ++orientation) {
      EXPECT_EQ(orientationFromExif(block(bigEndian, orientation)).exif, orientation) << bigEndian;
    }
  }
}

TEST(ExifOrientation, NumbersThatExifDoesNotHaveMeanUpright) {
  for (const int orientation : {0, 9, 300, 65535}) {
    EXPECT_EQ(orientationFromExif(block(true, orientation)).exif, 1) << orientation;
  }
}

TEST(ExifOrientation, EveryTruncationIsUprightOrWhatItWas) {
  for (const bool bigEndian : {false, true}) {
    const std::vector<std::byte> whole = block(bigEndian, 6);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const std::span<const std::byte> cut(whole.data(), length);
      // The value ends at byte 32; what follows does not matter.
      EXPECT_EQ(orientationFromExif(cut).exif, length < 32 ? 1 : 6) << length;
    }
  }
}

TEST(ExifOrientation, NoiseIsNeverAnythingElse) {
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::byte> bytes = block(i % 2 == 0, 6);
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    bytes.resize(random() % (bytes.size() + 1));
    const int exif = orientationFromExif(bytes).exif;
    ASSERT_TRUE(exif >= 1 && exif <= 8) << exif;
  }
}

}  // namespace
}  // namespace illum
