// The public stacks, where they are: not part of the project.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "capture/test_photographs.h"
#include "illum/capture.h"
#include "illum/colour.h"
#include "illum/picture_io.h"

namespace illum {
namespace {

std::filesystem::path sharedData() {
  if (const char* shared = std::getenv("ILLUM_SHARED"))
    return std::filesystem::path(shared) / "data";
  return std::filesystem::path(ILLUM_SOURCE_DIR) / ".." / "shared" / "data";
}

struct Stack {
  const char* folder;
  Size size;
  std::size_t lights;
};

class SharedStack : public testing::TestWithParam<Stack> {};

TEST_P(SharedStack, EqualsItsPhotographsDecodedByTheImageModule) {
  const Stack& stack = GetParam();
  const std::filesystem::path folder = sharedData() / stack.folder;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  test::Listener listener;
  const auto capture = openPhotographs(folder, {}, listener);
  EXPECT_EQ(capture->size(), stack.size);
  ASSERT_EQ(capture->lights().size(), stack.lights);
  EXPECT_THAT(listener.remarks, testing::IsEmpty());
  EXPECT_EQ(capture->transfer(), Transfer::Display);
  EXPECT_FALSE(capture->hasMask());

  const Rectangle all{0, 0, stack.size.width, stack.size.height};
  std::vector<float> samples(3 * all.pixels());
  for (const int light : {0, static_cast<int>(stack.lights) - 1}) {
    capture->read(0, all, std::span(&light, 1), samples);
    const auto file = folder / capture->lights()[static_cast<std::size_t>(light)].name;
    const Picture linear = readPicture(file);
    const int channels = linear.channels();
    float worst = 0;
    for (std::size_t p = 0; p < all.pixels(); ++p) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto at = p * static_cast<std::size_t>(channels) + (channels == 1 ? 0 : c);
        const float difference =
            linearFromDisplay(samples[c * all.pixels() + p]) - linear.samples()[at];
        worst = std::max(worst, std::abs(difference));
      }
    }
    EXPECT_LT(worst, 1e-6f) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Public, SharedStack,
                         testing::Values(Stack{"realrti01_door/stack", {487, 439}, 60},
                                         Stack{"realrti03_icon_michele/stack", {402, 395}, 72},
                                         Stack{"realrti08_clay_shell/stack", {362, 301}, 48},
                                         Stack{"realrti09_coin_a/stack", {279, 289}, 48},
                                         Stack{"realrti11_metal_statue_a/stack", {567, 534}, 54},
                                         Stack{"diligent_cat/stack", {290, 315}, 96},
                                         Stack{"synthrti_single_object2_m6/stack", {320, 320}, 49},
                                         Stack{"harvardps_scholar/stack", {1070, 790}, 20}),
                         [](const auto& test) {
                           std::string name = test.param.folder;
                           std::erase(name, '/');
                           return name;
                         });

}  // namespace
}  // namespace illum
