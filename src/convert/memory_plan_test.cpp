#include "convert/memory_plan.h"

#include <gmock/gmock.h>

#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kMebi = 1 << 20;

// A view of 192 planes of 512 x 512 pixels: 192 MiB.
Manifest manifestOfManyPlanes() {
  LightSlab slab;
  slab.size = {512, 512};
  Manifest manifest;
  manifest.tile = 256;
  manifest.bases.resize(1);
  manifest.bases[0].coding.offsets.resize(192);
  manifest.groups.push_back({{"a", SlabView{slab, 0, 0}}, 0, {}});
  return manifest;
}

ConversionMemory planned(std::uint64_t memoryBytes, bool newViews = true) {
  const int planes = 192;
  return planConversion(manifestOfManyPlanes(), {&planes, 1}, newViews, memoryBytes, 8);
}

TEST(ConversionMemory, MoreOfItTakesFewerParts) {
  EXPECT_EQ(planned(8192 * kMebi).planesAtOnce, 192);
  int before = 192;
  for (const std::uint64_t budget : {1600, 1300, 1100, 950}) {
    const ConversionMemory memory = planned(budget * kMebi);
    EXPECT_LE(memory.planesAtOnce, before) << budget;
    EXPECT_GE(memory.planesAtOnce, 1) << budget;
    EXPECT_GE(memory.tilesCoded, 1) << budget;
    EXPECT_LE(memory.viewBytes, budget * kMebi) << budget;
    before = memory.planesAtOnce;
  }
  EXPECT_LT(before, 192);
}

TEST(ConversionMemory, ThreadsShareWhatIsLeft) {
  EXPECT_EQ(planned(16384 * kMebi).tilesCoded, 8);
  EXPECT_LT(planned(1000 * kMebi).tilesCoded, 8);
}

TEST(ConversionMemory, TooLittleIsSaidWithWhatSuffices) {
  try {
    planned(200 * kMebi);
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Machine);
    EXPECT_THAT(error.what(), testing::HasSubstr("needs at least"));
  }
  EXPECT_NO_THROW(planned(600 * kMebi, false)) << "copies hold no view";
}

}  // namespace
}  // namespace illum
