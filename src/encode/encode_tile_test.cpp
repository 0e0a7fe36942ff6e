#include "encode/encode_tile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "codec/atlas.h"
#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;

constexpr Coding kCodings[] = {Coding::Png, Coding::Avif, Coding::Jpeg};

PlaneCodes randomCodes(int planes, Size tile, int bits, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> code(0, (1 << bits) - 1);
  PlaneCodes codes{planes, tile, {}};
  codes.values.resize(static_cast<std::size_t>(planes) * tile.pixels());
  for (auto& value : codes.values) value = static_cast<std::uint16_t>(code(random));
  return codes;
}

/// Like planes of photographs: smooth shapes, an edge, noise of one code's standard deviation.
PlaneCodes pictureLikeCodes(int planes, Size tile, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  PlaneCodes codes{planes, tile, {}};
  for (int k = 0; k < planes; ++k)
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x) {
        const double u = (x + 0.5) / tile.width, v = (y + 0.5) / tile.height;
        const double shape = 40 * std::sin(7 * u + k) * std::cos(5 * v - k) + (u + v > 1 ? 25 : 0);
        codes.values.push_back(static_cast<std::uint16_t>(
            std::clamp(std::lround(128 + shape / (1 + k / 3) + noise(random)), 0L, 255L)));
      }
  return codes;
}

PlaneCodes decoded(const std::vector<std::byte>& file, const PlaneCodes& like, Coding coding,
                   int bits) {
  return decodeTile(coding, bits, like.planes, like.tile, file, "SOURCE");
}

double rmsDifference(const PlaneCodes& a, const PlaneCodes& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += std::pow(static_cast<double>(a.values[i]) - b.values[i], 2);
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

TEST(EncodeTile, PngIsLosslessAtEveryDepth) {
  unsigned seed = 1;
  for (const int bits : {8, 10, 12, 16})
    for (int planes = 1; planes <= 7; ++planes)
      for (const Size tile : {Size{1, 1}, Size{8, 16}, Size{13, 21}}) {
        const PlaneCodes codes = randomCodes(planes, tile, bits, seed++);
        const auto file = encodeTile(codes, Coding::Png, bits, {});
        EXPECT_EQ(decoded(file, codes, Coding::Png, bits), codes)
            << bits << " bits, " << planes << " planes of " << tile.width << "x" << tile.height;
      }
}

TEST(EncodeTile, AvifOfQuality100IsLossless) {
  unsigned seed = 100;
  for (const int bits : {8, 10, 12})
    for (const int planes : {1, 2, 3, 5}) {
      const PlaneCodes codes = randomCodes(planes, {19, 33}, bits, seed++);
      const auto file = encodeTile(codes, Coding::Avif, bits, {100, 8});
      EXPECT_EQ(decoded(file, codes, Coding::Avif, bits), codes) << bits << " bits, " << planes;
    }
}

struct Budget {
  Coding coding;
  int quality;
  double leastError, mostError;  // rms, in codes
  std::size_t leastBytes, mostBytes;
};

// Two-sided, so that an unexplained improvement is looked at too.
TEST(EncodeTile, LossyCodingsKeepTheirBudgets) {
  const PlaneCodes codes = pictureLikeCodes(9, {256, 192}, 7);
  for (const Budget& budget : {
           Budget{Coding::Avif, 90, 0.95, 1.2, 9500, 13000},
           Budget{Coding::Avif, 75, 1.1, 1.35, 3200, 4400},
           Budget{Coding::Avif, 50, 1.3, 1.65, 1700, 2300},
           Budget{Coding::Avif, 20, 2.0, 2.7, 900, 1250},
           Budget{Coding::Jpeg, 100, 0.3, 0.5, 140000, 172000},
           Budget{Coding::Jpeg, 75, 0.8, 1.1, 12000, 60000},
           Budget{Coding::Jpeg, 50, 1.0, 1.9, 6600, 8200},
       }) {
    const auto file = encodeTile(codes, budget.coding, 8, {budget.quality, 6});
    const double error = rmsDifference(decoded(file, codes, budget.coding, 8), codes);
    const auto what = testing::Message() << nameOf(budget.coding) << " quality " << budget.quality
                                         << ": " << error << " rms, " << file.size() << " bytes";
    EXPECT_GE(error, budget.leastError) << what;
    EXPECT_LE(error, budget.mostError) << what;
    EXPECT_GE(file.size(), budget.leastBytes) << what;
    EXPECT_LE(file.size(), budget.mostBytes) << what;
  }
}

// A uniform quantiser of step s in an orthonormal transform errs by at most s/2 a coefficient, so
// by s/2 rms; rounding to whole codes adds 1/2 at most.
TEST(EncodeTile, JpegErrorIsBoundedByItsStep) {
  const PlaneCodes codes = randomCodes(3, {64, 64}, 8, 5);
  for (const int quality : {100, 90, 75, 60}) {
    const auto file = encodeTile(codes, Coding::Jpeg, 8, {quality, 6});
    EXPECT_LE(rmsDifference(decoded(file, codes, Coding::Jpeg, 8), codes),
              0.5 * jpegStep(quality) + 0.5)
        << "quality " << quality;
  }
}

TEST(EncodeTile, MoreQualityTakesMoreBytesAndErrsLess) {
  const PlaneCodes codes = pictureLikeCodes(6, {128, 128}, 3);
  for (const Coding coding : {Coding::Avif, Coding::Jpeg}) {
    std::size_t bytes = 0;
    double error = 1e9;
    for (const int quality : {10, 30, 50, 70, 90}) {
      const auto file = encodeTile(codes, coding, 8, {quality, 6});
      const double now = rmsDifference(decoded(file, codes, coding, 8), codes);
      EXPECT_GT(file.size(), bytes) << nameOf(coding) << " " << quality;
      EXPECT_LT(now, error) << nameOf(coding) << " " << quality;
      bytes = file.size();
      error = now;
    }
  }
}

TEST(EncodeTile, IsTheSameOnEveryThread) {
  const PlaneCodes codes = pictureLikeCodes(5, {90, 70}, 11);
  for (const Coding coding : kCodings) {
    const auto alone = encodeTile(codes, coding, 8, {60, 6});
    std::vector<std::vector<std::byte>> together(4);
    std::vector<std::thread> threads;
    for (auto& file : together)
      threads.emplace_back([&] { file = encodeTile(codes, coding, 8, {60, 6}); });
    for (auto& thread : threads) thread.join();
    for (const auto& file : together) EXPECT_EQ(file, alone) << nameOf(coding);
  }
}

// Three planes share a cell; the channels of a cell that has fewer must not cost what planes cost.
TEST(EncodeTile, ChannelsWithoutAPlaneAreNearlyFree) {
  const PlaneCodes three = pictureLikeCodes(3, {256, 256}, 13);
  PlaneCodes one{1, three.tile, {}};
  one.values.assign(three.plane(0).begin(), three.plane(0).end());
  for (const Coding coding : kCodings) {
    const auto small = encodeTile(one, coding, 8, {95, 6}).size();
    const auto large = encodeTile(three, coding, 8, {95, 6}).size();
    EXPECT_LT(static_cast<double>(small), 0.55 * static_cast<double>(large)) << nameOf(coding);
  }
}

// What coding lets seep from one cell of an atlas into another: the texels of a flat cell beside
// busy ones. docs/performance.md reports the figures that this prints.
TEST(EncodeTile, LittleSeepsFromABusyCellIntoAFlatOne) {
  constexpr Size kTile{120, 120};
  PlaneCodes codes = randomCodes(12, kTile, 8, 17);  // 2x2 cells
  for (int k = 3; k < 6; ++k) std::ranges::fill(codes.plane(k), std::uint16_t{100});
  for (const int quality : {80, 60, 40, 20, 0}) {
    const auto file = encodeTile(codes, Coding::Avif, 8, {quality, 6});
    const PlaneCodes seen = decoded(file, codes, Coding::Avif, 8);
    int largest = 0;
    double sum = 0;
    std::size_t changed = 0;
    for (int k = 3; k < 6; ++k)
      for (const auto value : seen.plane(k)) {
        largest = std::max(largest, std::abs(value - 100));
        sum += (value - 100) * (value - 100);
        changed += value != 100;
      }
    const double count = 3.0 * static_cast<double>(kTile.pixels());
    const double rms = std::sqrt(sum / count);
    const double all = rmsDifference(seen, codes);
    RecordProperty("quality" + std::to_string(quality),
                   "largest " + std::to_string(largest) + ", rms " + std::to_string(rms) +
                       ", changed " + std::to_string(static_cast<double>(changed) / count) +
                       ", rms of the whole tile " + std::to_string(all));
    EXPECT_LT(rms, 0.05 * all) << "quality " << quality;
  }
}

std::string textOf(const std::vector<std::byte>& file) {
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

TEST(EncodeTile, PngHoldsNothingButThePicture) {
  const std::string file = textOf(encodeTile(randomCodes(3, {64, 64}, 8, 1), Coding::Png, 8, {}));
  std::vector<std::string> chunks;
  for (std::size_t at = 8; at + 8 <= file.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length = length << 8 | static_cast<unsigned char>(file[at + i]);
    if (chunks.empty() || chunks.back() != file.substr(at + 4, 4))
      chunks.push_back(file.substr(at + 4, 4));
    at += length + 12;
  }
  EXPECT_THAT(chunks, testing::ElementsAre("IHDR", "IDAT", "IEND"));
}

// Adobe Technical Note 5116: transform 0 says that three components are RGB.
TEST(EncodeTile, JpegSaysThatItStoresRgbAndHasOneFlatTable) {
  const std::string file =
      textOf(encodeTile(randomCodes(3, {16, 16}, 8, 1), Coding::Jpeg, 8, {75, 6}));
  const std::size_t adobe = file.find("\xff\xee");
  ASSERT_NE(adobe, std::string::npos);
  EXPECT_EQ(file.substr(adobe + 4, 5), "Adobe");
  EXPECT_EQ(file[adobe + 15], 0);
  const std::size_t table = file.find("\xff\xdb");
  ASSERT_NE(table, std::string::npos);
  EXPECT_EQ(file.substr(table + 4, 65), std::string(1, '\0') + std::string(64, '\4'));
  EXPECT_EQ(file.find("\xff\xdb", table + 1), std::string::npos);
  EXPECT_EQ(file.find("JFIF"), std::string::npos);
}

// ISO/IEC 14496-12, colour information box: primaries 1, transfer 13, matrix 0, full range.
TEST(EncodeTile, AvifSaysWhichColourItIs) {
  using namespace std::string_literals;
  for (const int bits : {8, 10}) {
    const std::string file =
        textOf(encodeTile(randomCodes(3, {16, 16}, bits, 1), Coding::Avif, bits, {75, 6}));
    EXPECT_THAT(file, HasSubstr("colrnclx\0\1\0\15\0\0\200"s)) << bits;
  }
}

TEST(EncodeTile, RefusesWhatItCannotCode) {
  const PlaneCodes codes = randomCodes(3, {8, 8}, 8, 1);
  const auto faultOf = [&](Coding coding, int bits, EncodeSettings settings) {
    try {
      encodeTile(codes, coding, bits, settings);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(faultOf(Coding::Jpeg, 10, {}), HasSubstr("jpeg cannot hold 10 bits"));
  EXPECT_THAT(faultOf(Coding::Avif, 16, {}), HasSubstr("avif cannot hold 16 bits"));
  EXPECT_THAT(faultOf(Coding::Avif, 8, {101, 6}), HasSubstr("quality from 0 to 100, found 101"));
  EXPECT_THAT(faultOf(Coding::Avif, 8, {-1, 6}), HasSubstr("found -1"));
  EXPECT_THAT(faultOf(Coding::Avif, 8, {50, 11}), HasSubstr("speed from 0 to 10, found 11"));
}

TEST(DecodeTile, RefusesCodesBeyondTheirBits) {
  PlaneCodes codes = randomCodes(3, {8, 8}, 10, 1);
  codes.values[70] = 1024;
  const auto file = encodeTile(codes, Coding::Png, 16, {});
  try {
    decodeTile(Coding::Png, 10, 3, {8, 8}, file, "SOURCE");
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "SOURCE: expected codes of 10 bits, found 1024");
  }
}

TEST(EncodeMaskTile, IsLossless) {
  for (const Size size : {Size{1, 1}, Size{37, 5}, Size{64, 64}}) {
    BytePicture mask(size, 1);
    std::mt19937 random(2);
    for (auto& sample : mask.samples()) sample = static_cast<std::uint8_t>(random());
    EXPECT_EQ(decodeMaskTile(size, encodeMaskTile(mask), "SOURCE"), mask) << size.width;
  }
}

TEST(Quality, ScalesAreThoseOfTheFormat) {
  EXPECT_EQ(jpegStep(100), 1);
  EXPECT_EQ(jpegStep(75), 4);
  EXPECT_EQ(jpegStep(50), 16);
  EXPECT_EQ(jpegStep(25), 64);
  EXPECT_EQ(jpegStep(0), 255);
  EXPECT_EQ(avifQuantizer(100), 0);
  EXPECT_EQ(avifQuantizer(50), 32);
  EXPECT_EQ(avifQuantizer(0), 63);
}

}  // namespace
}  // namespace illum
