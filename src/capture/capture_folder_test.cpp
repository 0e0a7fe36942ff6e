#include "illum/capture_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cmath>
#include <numeric>

#include "capture/test_photographs.h"
#include "illum/error.h"
#include "illum/picture_io.h"

namespace illum {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Three views of a slab under five lights, every sample another number.
class NumberedCapture final : public Capture {
 public:
  NumberedCapture() {
    LightSlab slab;
    slab.name = "s";
    slab.objectFromSlab = rotationAbout(Direction::fromVector({0, 1, 0}), 0.5);
    slab.uCount = 3;
    slab.size = {70, 41};
    for (int u = 0; u < 3; ++u)
      views_.push_back({"view " + std::to_string(u), SlabView{slab, u, 0}});
    for (int i = 0; i < 5; ++i) {
      lights_.push_back(
          {"light " + std::to_string(i), {Direction::fromAngles(0.2 * i, 0.9 * i), {1, 1, 1}}, 0});
    }
  }
  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return Transfer::Linear; }
  const std::vector<LightFileEntry>& lights() const override { return lights_; }
  bool hasMask() const override { return true; }
  bool hasDepth() const override { return true; }
  bool isRendered() const override { return true; }
  void read(int group, const Rectangle& r, std::span<const int> lights,
            std::span<float> samples) const override {
    std::size_t at = 0;
    for (const int light : lights)
      for (int c = 0; c < 3; ++c)
        for (int y = r.y; y < r.bottom(); ++y)
          for (int x = r.x; x < r.right(); ++x)
            samples[at++] = std::exp2(static_cast<float>((group * 5 + light) * 3 + c) / 4) /
                            static_cast<float>(1 + 70 * y + x);
  }
  void readMask(int group, const Rectangle& r, std::span<float> coverage) const override {
    fill(r, coverage, [&](int x, int y) { return static_cast<float>((x + y + group) % 5) / 4; });
  }
  void readDepth(int group, const Rectangle& r, std::span<float> depth) const override {
    fill(r, depth, [&](int x, int y) {
      return (x + y + group) % 5 == 0 ? INFINITY : static_cast<float>(x * y - group) / 7;
    });
  }
  int bandRows() const override { return 41; }
  std::uint64_t residentBytes() const override { return 0; }
  std::string fingerprint() const override { return "numbered"; }

 private:
  template <typename Value>
  static void fill(const Rectangle& r, std::span<float> values, Value value) {
    std::size_t at = 0;
    for (int y = r.y; y < r.bottom(); ++y)
      for (int x = r.x; x < r.right(); ++x) values[at++] = value(x, y);
  }
  std::vector<View> views_;
  std::vector<LightFileEntry> lights_;
};

std::vector<float> samplesOf(const Capture& capture, int group, const Rectangle& rectangle) {
  std::vector<int> lights(capture.lights().size());
  std::iota(lights.begin(), lights.end(), 0);
  std::vector<float> samples(3 * lights.size() * rectangle.pixels());
  capture.read(group, rectangle, lights, samples);
  return samples;
}

std::string refusalOf(const fs::path& folder) {
  Progress silent;
  try {
    const auto capture = openCaptureFolder(folder, {}, silent);
    for (int group = 0; group < capture->groups(); ++group) {
      samplesOf(*capture, group, {0, 0, 2, 2});
    }
    return "taken";
  } catch (const Error& error) {
    return error.what();
  }
}

class CaptureFolderTest : public testing::Test {
 protected:
  // A little memory makes batches of lights.
  void write(std::uint64_t memoryBytes = 0, bool half = false) {
    CaptureFolderOptions options;
    options.memoryBytes = memoryBytes;
    options.half = half;
    options.force = true;
    ASSERT_TRUE(writeCaptureFolder(capture_, path_, options, progress_));
  }

  NumberedCapture capture_;
  Progress progress_;
  test::Folder folder_;
  fs::path path_ = folder_.path() / "capture";
};

TEST_F(CaptureFolderTest, OpensAsWhatWasWritten) {
  for (const std::uint64_t memoryBytes : {std::uint64_t{1}, std::uint64_t{1} << 30}) {
    write(memoryBytes);
    const auto back = openCaptureFolder(path_, {}, progress_);
    EXPECT_EQ(back->views(), capture_.views());
    EXPECT_EQ(back->transfer(), Transfer::Linear);
    EXPECT_TRUE(back->hasMask());
    EXPECT_TRUE(back->hasDepth());
    EXPECT_TRUE(back->isRendered());
    ASSERT_EQ(back->lights().size(), capture_.lights().size());
    for (std::size_t i = 0; i < back->lights().size(); ++i) {
      EXPECT_EQ(back->lights()[i].name, capture_.lights()[i].name);
      EXPECT_EQ(back->lights()[i].light.toLight, capture_.lights()[i].light.toLight);
    }
    const Rectangle part{13, 5, 50, 33};
    for (const int group : {2, 0, 1, 2, 0}) {
      EXPECT_EQ(samplesOf(*back, group, part), samplesOf(capture_, group, part)) << group;
      std::vector<float> expected(part.pixels()), found(part.pixels());
      capture_.readMask(group, part, expected);
      back->readMask(group, part, found);
      EXPECT_EQ(found, expected) << "mask " << group;
      capture_.readDepth(group, part, expected);
      back->readDepth(group, part, found);
      EXPECT_EQ(found, expected) << "depth " << group;
    }
  }
}

TEST_F(CaptureFolderTest, SaysItsSizeBeforehand) {
  const std::uint64_t pixels = 3 * 70 * 41;
  EXPECT_EQ(captureFolderBytes(capture_, false), pixels * (5 * 12 + 8));
  EXPECT_EQ(captureFolderBytes(capture_, true), pixels * (5 * 6 + 8));
}

TEST_F(CaptureFolderTest, EachViewIsAStackWithLightsInItsOwnFrame) {
  write();
  const auto stack = openPhotographs(path_ / "views/0001", {}, progress_);
  ASSERT_EQ(stack->lights().size(), 5u);
  const RigidTransform slabFromObject = inverse(objectFromGroup(capture_.views()[1].geometry));
  const Direction expected = slabFromObject.direction(capture_.lights()[3].light.toLight);
  EXPECT_LT(angleRadians(stack->lights()[3].light.toLight, expected), 1e-12);
}

TEST_F(CaptureFolderTest, HalvesTakeLessAndAreNear) {
  write(0, true);
  const auto back = openCaptureFolder(path_, {}, progress_);
  const Rectangle part{0, 0, 20, 10};
  const auto expected = samplesOf(capture_, 0, part), found = samplesOf(*back, 0, part);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_NEAR(found[i], expected[i], expected[i] / 2048 + 1e-7);
  }
  EXPECT_NE(found, expected);
}

// Views are opened in parallel, under a lock: whoever waits for that must not begin to read
// another.
TEST_F(CaptureFolderTest, ManyThreadsReadManyViews) {
  write();
  constexpr std::size_t kThreads = 8;
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  arena.execute([&] {
    for (int round = 0; round < 120; ++round) {
      const auto back = openCaptureFolder(path_, {}, progress_);
      tbb::parallel_for(0, 24, [&](int i) {
        const int group = i * 7 % capture_.groups();
        const Rectangle part{i % 30, i % 11, 3, 2};
        ASSERT_EQ(samplesOf(*back, group, part), samplesOf(capture_, group, part));
      });
    }
  });
}

TEST_F(CaptureFolderTest, ReplacesCapturesOnlyWhenAsked) {
  write();
  EXPECT_THROW(writeCaptureFolder(capture_, path_, {}, progress_), Error);
  const fs::path precious = folder_.path() / "precious";
  fs::create_directories(precious);
  folder_.writeText("precious/letter.txt", "kept");
  CaptureFolderOptions options;
  options.force = true;
  EXPECT_THROW(writeCaptureFolder(capture_, precious, options, progress_), Error);
  EXPECT_TRUE(fs::exists(precious / "letter.txt"));
}

TEST_F(CaptureFolderTest, AStoppedCaptureLeavesNothing) {
  CaptureFolderOptions options;
  std::atomic<int> steps = 0;
  options.stop = [&] { return ++steps >= 7; };
  EXPECT_FALSE(writeCaptureFolder(capture_, path_, options, progress_));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(CaptureFolderTest, WhatIsMissingOrOfAnotherSizeIsNamed) {
  write();
  EXPECT_EQ(refusalOf(path_), "taken");
  const fs::path victim = path_ / "views/0002/light_0003.exr";
  fs::rename(victim, folder_.path() / "kept.exr");
  EXPECT_THAT(refusalOf(path_), HasSubstr("views/0002/light_0003.exr"));
  writePicture(victim, Picture({70, 40}, 3));
  EXPECT_THAT(refusalOf(path_), HasSubstr("light_0003.exr: expected 70x41 pixels"));
  fs::rename(folder_.path() / "kept.exr", victim);
  writePicture(path_ / "views/0001/mask.exr", Picture({70, 40}, 1));
  EXPECT_THAT(refusalOf(path_), HasSubstr("mask.exr: expected one channel of 70x41 pixels"));
  fs::remove(path_ / "capture.json");
  EXPECT_THAT(refusalOf(path_), HasSubstr("capture.json"));
}

}  // namespace
}  // namespace illum
