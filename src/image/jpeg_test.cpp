#include <cstddef>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <jpeglib.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include "illum/picture_io.h"
#include "image/formats.h"
#include "image/hostile_bytes_for_test.h"

namespace illum {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using Bytes = std::vector<std::byte>;

BytePicture decode(std::span<const std::byte> bytes) {
  return decodeJpeg(bytes, "hostile").bytes;
}

/// A JPEG of any kind with flat pixels of `value`.
Bytes makeJpeg(Size size, int channels, J_COLOR_SPACE space,
               const std::function<void(jpeg_compress_struct&)>& describe = {}, int value = 100) {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors{};
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* buffer = nullptr;
  unsigned long length = 0;
  jpeg_mem_dest(&codec, &buffer, &length);
  codec.image_width = static_cast<JDIMENSION>(size.width);
  codec.image_height = static_cast<JDIMENSION>(size.height);
  codec.input_components = channels;
  codec.in_color_space = space;
  jpeg_set_defaults(&codec);
  if (describe) describe(codec);
  jpeg_start_compress(&codec, TRUE);
  std::vector<JSAMPLE> row(static_cast<std::size_t>(size.width * channels),
                           static_cast<JSAMPLE>(value));
  JSAMPROW pointer = row.data();
  while (codec.next_scanline < codec.image_height) jpeg_write_scanlines(&codec, &pointer, 1);
  jpeg_finish_compress(&codec);
  const auto* first = reinterpret_cast<const std::byte*>(buffer);
  Bytes bytes(first, first + length);
  jpeg_destroy_compress(&codec);
  std::free(buffer);
  return bytes;
}

BytePicture waves(Size size, int channels) {
  BytePicture picture(size, channels);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < channels; ++c)
        picture.at(x, y, c) = static_cast<std::uint8_t>(128 + 100 * std::sin(0.21 * x * (c + 1)) *
                                                                  std::cos(0.17 * y));
  return picture;
}

double rmsDifference(const BytePicture& a, const BytePicture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.samples().size(); ++i) {
    const double difference = a.samples()[i] - b.samples()[i];
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.samples().size()));
}

TEST(Jpeg, RoundTripsWithinItsQuality) {
  for (const int channels : {1, 3}) {
    for (const Size size : {Size{1, 1}, Size{17, 9}, Size{3000, 2}, Size{64, 64}}) {
      const BytePicture picture = waves(size, channels);
      const BytePicture fine = decode(encodeJpeg(picture, 100));
      ASSERT_EQ(fine.size(), size);
      ASSERT_EQ(fine.channels(), channels);
      EXPECT_LT(rmsDifference(fine, picture), 1.5) << size.width << 'x' << channels;
    }
  }
}

TEST(Jpeg, QualityBuysBytesAndAccuracy) {
  const BytePicture picture = waves({128, 128}, 3);
  std::size_t bytesBefore = 0;
  double differenceBefore = 1000;
  for (const int quality : {10, 50, 90, 100}) {
    const Bytes bytes = encodeJpeg(picture, quality);
    const double difference = rmsDifference(decode(bytes), picture);
    EXPECT_GT(bytes.size(), bytesBefore) << quality;
    EXPECT_LT(difference, differenceBefore) << quality;
    bytesBefore = bytes.size();
    differenceBefore = difference;
  }
}

// With chroma at half resolution alternating red and blue would come out grey.
TEST(Jpeg, ColourKeepsItsFullResolution) {
  BytePicture picture({32, 32}, 3);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) picture.at(x, y, x % 2 == 0 ? 0 : 2) = 200;
  const BytePicture decoded = decode(encodeJpeg(picture, 98));
  EXPECT_GT(decoded.at(10, 10, 0), 170);
  EXPECT_LT(decoded.at(10, 10, 2), 30);
  EXPECT_GT(decoded.at(11, 10, 2), 170);
}

TEST(Jpeg, SameBytesEveryTime) {
  EXPECT_EQ(encodeJpeg(waves({40, 30}, 3), 80), encodeJpeg(waves({40, 30}, 3), 80));
}

TEST(Jpeg, AlphaIsRefused) {
  try {
    encodeJpeg(BytePicture({2, 2}, 4), 90);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    EXPECT_THAT(error.what(), HasSubstr("1 or 3 channels"));
  }
}

TEST(Jpeg, ProgressiveAndSubsampledFilesAreRead) {
  const auto progressive = [](jpeg_compress_struct& codec) { jpeg_simple_progression(&codec); };
  const BytePicture grey = decode(makeJpeg({33, 20}, 1, JCS_GRAYSCALE, progressive));
  EXPECT_NEAR(grey.at(32, 19, 0), 100, 1);
  const BytePicture colour = decode(makeJpeg({33, 20}, 3, JCS_RGB, progressive));  // 4:2:0
  ASSERT_EQ(colour.channels(), 3);
  EXPECT_NEAR(colour.at(32, 19, 2), 100, 1);
}

std::string refusalOf(const Bytes& bytes) {
  try {
    decode(bytes);
    return "taken";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Jpeg, KindsWithoutGreyOrRgbAreRefused) {
  EXPECT_EQ(refusalOf(makeJpeg({8, 8}, 4, JCS_CMYK)),
            "hostile: expected a grey or RGB JPEG, found CMYK");
  const auto ycck = [](jpeg_compress_struct& codec) { jpeg_set_colorspace(&codec, JCS_YCCK); };
  EXPECT_THAT(refusalOf(makeJpeg({8, 8}, 4, JCS_CMYK, ycck)), HasSubstr("found CMYK"));
  EXPECT_THAT(refusalOf(makeJpeg({8, 8}, 2, JCS_UNKNOWN)), HasSubstr("2 channels"));
  const auto arithmetic = [](jpeg_compress_struct& codec) { codec.arith_code = TRUE; };
  EXPECT_THAT(refusalOf(makeJpeg({8, 8}, 1, JCS_GRAYSCALE, arithmetic)), HasSubstr("arithmetic"));
}

TEST(Jpeg, EveryProperTruncationIsRefused) {
  EXPECT_THAT(takenTruncations(encodeJpeg(waves({20, 12}, 3), 70), decode), IsEmpty());
  const auto progressive = [](jpeg_compress_struct& codec) { jpeg_simple_progression(&codec); };
  EXPECT_THAT(takenTruncations(makeJpeg({20, 12}, 3, JCS_RGB, progressive), decode), IsEmpty());
}

TEST(Jpeg, EveryBitFlipIsTakenOrRefused) {
  const Bytes bytes = encodeJpeg(waves({20, 12}, 3), 70);
  const std::size_t taken = takenBitFlips(bytes, decode);
  EXPECT_GT(taken, 100U) << "a JPEG has no checksum";
  EXPECT_LT(taken, 8 * bytes.size());
  const auto progressive = [](jpeg_compress_struct& codec) { jpeg_simple_progression(&codec); };
  EXPECT_GT(takenBitFlips(makeJpeg({20, 12}, 3, JCS_RGB, progressive), decode), 100U);
}

std::size_t frameHeaderOf(const Bytes& bytes) {
  for (std::size_t i = 0; i + 1 < bytes.size(); ++i)
    if (bytes[i] == std::byte{0xFF} && bytes[i + 1] == std::byte{0xC0}) return i;
  return bytes.size();
}

TEST(Jpeg, DeclaredSizesAreNotBelieved) {
  Bytes bytes = makeJpeg({8, 8}, 1, JCS_GRAYSCALE);
  const std::size_t frame = frameHeaderOf(bytes);
  ASSERT_LT(frame, bytes.size());
  bytes[frame + 5] = bytes[frame + 7] = std::byte{0x40};  // 16392 x 16392
  EXPECT_THAT(refusalOf(bytes), HasSubstr("data for 16392 x 16392 pixels"));
  bytes[frame + 5] = bytes[frame + 7] = std::byte{0xFF};  // beyond the format's own limit
  EXPECT_FALSE(isTaken(bytes, decode));
}

/// Every coefficient in scans of its own, one for each of its ten lowest bits.
std::vector<jpeg_scan_info> scansForEveryBit(int lastCoefficient) {
  std::vector<jpeg_scan_info> scans = {{1, {0}, 0, 0, 0, 0}};
  for (int k = 1; k <= lastCoefficient; ++k)
    for (int bit = 9; bit >= 0; --bit) scans.push_back({1, {0}, k, k, bit == 9 ? 0 : bit + 1, bit});
  return scans;
}

// A scan of a few bytes makes the decoder walk the whole picture once more.
TEST(Jpeg, ManyScansAreRefused) {
  for (const int lastCoefficient : {40, 63}) {
    const std::vector<jpeg_scan_info> scans = scansForEveryBit(lastCoefficient);
    const auto script = [&](jpeg_compress_struct& codec) {
      codec.scan_info = scans.data();
      codec.num_scans = static_cast<int>(scans.size());
    };
    const Bytes bytes = makeJpeg({64, 64}, 1, JCS_GRAYSCALE, script);
    EXPECT_EQ(isTaken(bytes, decode), scans.size() <= 500) << scans.size();
  }
}

TEST(Jpeg, FillBytesBeforeAMarkerAreHarmless) {
  Bytes bytes = makeJpeg({8, 8}, 1, JCS_GRAYSCALE);
  bytes.insert(bytes.end() - 2, 3, std::byte{0xFF});
  EXPECT_TRUE(isTaken(bytes, decode));
}

}  // namespace
}  // namespace illum
