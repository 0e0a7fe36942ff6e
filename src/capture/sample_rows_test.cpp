#include "capture/sample_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "capture/sample_kernels.h"

namespace illum {
namespace {

TEST(SampleKernels, QuotientsAreCorrectlyRounded) {
  std::vector<std::uint16_t> words(65536);
  std::iota(words.begin(), words.end(), std::uint16_t{0});
  std::vector<float> r(words.size()), g(words.size()), b(words.size());
  planarFromWords(words.data(), 1, words.size(), r.data(), g.data(), b.data());
  for (std::size_t i = 0; i < words.size(); ++i) {
    ASSERT_EQ(r[i], static_cast<float>(i) / 65535.0f) << i;
    ASSERT_EQ(g[i], r[i]);
    ASSERT_EQ(b[i], r[i]);
  }
  std::vector<std::uint8_t> bytes(256);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  planarFromBytes(bytes.data(), 1, bytes.size(), r.data(), g.data(), b.data());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    ASSERT_EQ(r[i], static_cast<float>(i) / 255.0f) << i;
  }
}

// The obvious loop, for every number of pixels that a vector's width could get wrong.
template <typename T, typename Kernel>
void expectPlanes(Kernel kernel, float white) {
  std::vector<T> samples(4 * 200);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<T>(i * 37);
  for (const int channels : {1, 3, 4}) {
    for (std::size_t count = 0; count < 150; ++count) {
      std::vector<float> planes(3 * (count + 1), -1.0f);
      float* r = planes.data();
      float* g = r + count + 1;
      float* b = g + count + 1;
      kernel(samples.data() + 1, channels, count, r, g, b);
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at =
              1 + i * static_cast<std::size_t>(channels) + (channels == 1 ? 0 : c);
          ASSERT_EQ(planes[c * (count + 1) + i], static_cast<float>(samples[at]) / white)
              << channels << " " << count << " " << i;
        }
      }
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(planes[c * (count + 1) + count], -1.0f);
    }
  }
}

TEST(SampleKernels, PlanesAreThoseOfTheObviousLoop) {
  expectPlanes<std::uint8_t>(planarFromBytes, 255);
  expectPlanes<std::uint16_t>(planarFromWords, 65535);
  expectPlanes<float>(planarFromFloats, 1);
}

TEST(SampleKernels, OneBadFloatIsFound) {
  std::vector<float> samples(100, -3.0e38f);
  EXPECT_TRUE(allFinite(samples.data(), samples.size()));
  for (const float bad :
       {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
        std::numeric_limits<float>::quiet_NaN()}) {
    for (const std::size_t at : {std::size_t{0}, std::size_t{57}, std::size_t{99}}) {
      samples[at] = bad;
      EXPECT_FALSE(allFinite(samples.data(), samples.size())) << at;
      samples[at] = 0;
    }
  }
}

// One pixel through a converter.
std::array<float, 3> convert(const RowConverter& converter, const void* sample, bool linear) {
  std::array<float, 3> out{};
  const std::array<float*, 3> rgb{&out[0], &out[1], &out[2]};
  const auto* bytes = static_cast<const std::byte*>(sample);
  if (linear) {
    converter.toLinear(bytes, 0, 1, rgb);
  } else {
    converter.toTransfer(bytes, 0, 1, rgb);
  }
  return out;
}

TEST(RowConverter, DividesInLinearLightWhateverTheType) {
  const LinearRgb intensity{0.5f, 2, 3};
  const float unit = 0.4f;
  const std::uint8_t byte3[] = {102, 102, 102};
  const std::uint16_t word3[] = {26214, 26214, 26214};
  const float float3[] = {unit, unit, unit};
  const struct {
    SampleType type;
    const void* sample;
  } kinds[] = {{SampleType::Byte, byte3}, {SampleType::Word, word3}, {SampleType::Float, float3}};
  for (const auto& kind : kinds) {
    for (const Transfer transfer : {Transfer::Linear, Transfer::Display}) {
      const RowConverter converter(kind.type, 3, transfer, intensity);
      const auto linear = convert(converter, kind.sample, true);
      const auto inTransfer = convert(converter, kind.sample, false);
      const float intensities[] = {0.5f, 2, 3};
      for (std::size_t c = 0; c < 3; ++c) {
        const float light =
            (transfer == Transfer::Display ? linearFromDisplay(unit) : unit) / intensities[c];
        EXPECT_NEAR(linear[c], light, 1e-6f);
        EXPECT_NEAR(inTransfer[c], transfer == Transfer::Display ? displayFromLinear(light) : light,
                    1e-6f);
      }
    }
  }
}

TEST(RowConverter, StepsGoBackwardAndAcrossAlpha) {
  const std::uint8_t pixels[] = {10, 20, 30, 128, 40, 50, 60, 255};
  const RowConverter converter(SampleType::Byte, 4, Transfer::Display, {1, 1, 1});
  std::array<float, 2> r{}, g{}, b{}, alpha{};
  const std::array<float*, 3> rgb{r.data(), g.data(), b.data()};
  const auto* last = reinterpret_cast<const std::byte*>(pixels) + 4;
  converter.toTransfer(last, -4, 2, rgb);
  converter.alpha(last, -4, 2, alpha.data());
  EXPECT_EQ(r, (std::array{40 / 255.0f, 10 / 255.0f}));
  EXPECT_EQ(g, (std::array{50 / 255.0f, 20 / 255.0f}));
  EXPECT_EQ(b, (std::array{60 / 255.0f, 30 / 255.0f}));
  EXPECT_EQ(alpha, (std::array{1.0f, 128 / 255.0f}));
}

TEST(RowConverter, GreyWithAlphaIsGreyThreeTimes) {
  const std::uint16_t pixel[] = {13107, 65535};
  const RowConverter converter(SampleType::Word, 2, Transfer::Linear, {1, 1, 1});
  const auto out = convert(converter, pixel, false);
  EXPECT_EQ(out, (std::array{0.2f, 0.2f, 0.2f}));
}

}  // namespace
}  // namespace illum
