#include "capture/band_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;

Photograph photograph(Size size, bool sequential, int exif, std::uint64_t decoderBytes) {
  Photograph result;
  result.header.stored = size;
  result.header.sequential = sequential;
  result.header.orientation = {exif};
  result.header.decoderBytes = decoderBytes;
  return result;
}

BandRequest requestFor(int rows, std::uint64_t memoryBytes) {
  BandRequest request;
  request.rows = rows;
  request.memoryBytes = memoryBytes;
  request.threads = 8;
  return request;
}

TEST(BandPlan, AStackThatFillsHalfTheMemoryIsDecodedOnce) {
  const std::vector<Photograph> stack(10, photograph({1000, 1000}, true, 1, 100000));
  const std::uint64_t bytes = 30000000;
  const BandPlan fits = planBands(stack, requestFor(1000, 2 * bytes), "x");
  EXPECT_TRUE(fits.whole);
  EXPECT_EQ(fits.rows, 1000);
  EXPECT_EQ(fits.lanes, 8);
  EXPECT_EQ(fits.scratchBytes, 0u);
  EXPECT_EQ(fits.residentBytes, bytes + 8 * 100000);
  EXPECT_FALSE(planBands(stack, requestFor(1000, 2 * bytes - 1), "x").whole);
}

TEST(BandPlan, LargeDecodersWorkInFewerLanes) {
  const std::vector<Photograph> stack(10, photograph({1000, 1000}, false, 1, 12000000));
  const BandPlan plan = planBands(stack, requestFor(1000, 60000000), "x");
  EXPECT_TRUE(plan.whole);
  EXPECT_EQ(plan.lanes, 2);
}

TEST(BandPlan, BandsTakeWhatDecodersLeave) {
  const std::vector<Photograph> stack(100, photograph({1000, 1000}, true, 1, 100000));
  const BandPlan plan = planBands(stack, requestFor(1000, 20000000), "x");
  EXPECT_FALSE(plan.whole);
  EXPECT_EQ(plan.rows, 32) << "33 rows of 300 kB fit into the 10 MB that are left";
  EXPECT_EQ(plan.residentBytes, 100 * 100000 + 32 * 300000u);
}

TEST(BandPlan, OnlyWhatCannotBeReadInOrderGoesToScratch) {
  EXPECT_FALSE(needsScratch(photograph({10, 10}, true, 1, 0)));
  EXPECT_FALSE(needsScratch(photograph({10, 10}, true, 2, 0)));
  EXPECT_TRUE(needsScratch(photograph({10, 10}, true, 3, 0)));
  EXPECT_TRUE(needsScratch(photograph({10, 10}, true, 6, 0)));
  EXPECT_TRUE(needsScratch(photograph({10, 10}, false, 1, 0)));
  std::vector<Photograph> stack(99, photograph({1000, 1000}, true, 1, 100000));
  stack.push_back(photograph({1000, 1000}, false, 1, 4000000));
  const BandPlan plan = planBands(stack, requestFor(1000, 20000000), "x");
  const auto bands = static_cast<std::uint64_t>((1000 + plan.rows - 1) / plan.rows);
  EXPECT_EQ(plan.scratchBytes, bands * static_cast<unsigned>(plan.rows) * 3000);
}

// 600 photographs of 12 megapixels: the numbers that people meet.
TEST(BandPlan, LargeStacksFitIntoLittle) {
  const std::vector<Photograph> baseline(600, photograph({4000, 3000}, true, 1, 400000));
  const BandPlan bands = planBands(baseline, requestFor(3000, 1024 * kMebibyte), "x");
  EXPECT_LE(bands.residentBytes, 1024 * kMebibyte);
  EXPECT_GE(bands.rows, 64);
  const std::vector<Photograph> progressive(600, photograph({4000, 3000}, false, 1, 40000000));
  const BandPlan scratch = planBands(progressive, requestFor(3000, 1024 * kMebibyte), "x");
  EXPECT_LE(scratch.residentBytes, 1024 * kMebibyte);
  EXPECT_GE(scratch.scratchBytes, 600 * std::uint64_t{36000000});
}

TEST(BandPlan, TooLittleIsAFaultOfTheMachineWithTheLeast) {
  const std::vector<Photograph> stack(100, photograph({1000, 1000}, true, 1, 100000));
  try {
    planBands(stack, requestFor(1000, 12399999), "folder");
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Machine);
    EXPECT_STREQ(error.what(),
                 "folder: reading 100 photographs of 1000x1000 pixels needs at least 11.8 MiB of "
                 "memory, --max-memory gives it 11.8 MiB");
  }
  EXPECT_EQ(planBands(stack, requestFor(1000, 12400000), "folder").rows, 8);
}

// Whatever is asked for: within memory, whole bands, lanes that can work.
TEST(BandPlan, KeepsItsPromisesForAnyStack) {
  std::mt19937 random(5);
  int planned = 0;
  for (int i = 0; i < 3000; ++i) {
    const Size size{1 + static_cast<int>(random() % 3000), 1 + static_cast<int>(random() % 3000)};
    std::vector<Photograph> stack;
    const std::size_t count = 1 + random() % 50;
    for (std::size_t k = 0; k < count; ++k) {
      const int exif = random() % 4 == 0 ? 3 : 1;
      stack.push_back(photograph(size, random() % 3 != 0, exif, random() % 3000000));
    }
    BandRequest request = requestFor(size.height, random() % (200 * kMebibyte));
    request.rowStep = 8 * (1 + static_cast<int>(random() % 3));
    request.otherBytes = random() % kMebibyte;
    try {
      const BandPlan plan = planBands(stack, request, "x");
      ++planned;
      ASSERT_LE(plan.residentBytes, request.memoryBytes);
      ASSERT_GE(plan.lanes, plan.whole || plan.scratchBytes > 0 ? 1 : 0);
      ASSERT_TRUE(plan.rows == size.height || plan.rows % request.rowStep == 0);
      ASSERT_GE(plan.rows, std::min(size.height, request.rowStep));
    } catch (const Error&) {
      // Too little memory: with all there is, the same stack has a plan.
      request.memoryBytes = std::uint64_t{1} << 40;
      ASSERT_TRUE(planBands(stack, request, "x").whole);
    }
  }
  EXPECT_GT(planned, 1000);
}

}  // namespace
}  // namespace illum
