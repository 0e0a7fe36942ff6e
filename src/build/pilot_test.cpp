#include "build/pilot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "illum/error.h"

namespace illum {
namespace {

/// Views whose samples say where they come from: view, column, row in the three channels.
class Places final : public Capture {
 public:
  Places(int views, Size size, bool rendered) : rendered_(rendered) {
    for (int v = 0; v < views; ++v) {
      PinholeCamera camera;
      camera.size = size;
      views_.push_back({std::to_string(v), camera});
    }
    lights_.push_back({"a", {}, 1});
  }
  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return Transfer::Linear; }
  const std::vector<LightFileEntry>& lights() const override { return lights_; }
  bool hasMask() const override { return true; }
  bool isRendered() const override { return rendered_; }
  void read(int group, const Rectangle& r, std::span<const int>,
            std::span<float> samples) const override {
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      samples[i] = static_cast<float>(group);
      samples[r.pixels() + i] = static_cast<float>(r.x + static_cast<int>(i) % r.width);
      samples[2 * r.pixels() + i] = static_cast<float>(r.y + static_cast<int>(i) / r.width);
    }
  }
  void readMask(int, const Rectangle& r, std::span<float> coverage) const override {
    for (std::size_t i = 0; i < coverage.size(); ++i) {
      const int x = r.x + static_cast<int>(i) % r.width, y = r.y + static_cast<int>(i) / r.width;
      coverage[i] = shown_(x, y);
    }
  }
  int bandRows() const override { return 1000; }
  std::uint64_t residentBytes() const override { return 0; }
  std::string fingerprint() const override { return {}; }

  float (*shown_)(int, int) = [](int, int) { return 1.0f; };

 private:
  std::vector<View> views_;
  std::vector<LightFileEntry> lights_;
  bool rendered_;
};

/// All samples of one channel under the only light.
std::vector<float> channelOf(const Pilot& pilot, std::size_t c) {
  std::vector<float> all;
  for (const Pilot::Block& block : pilot.blocks) {
    const auto samples = pilot.samples(block).subspan(c * block.pixels, block.pixels);
    all.insert(all.end(), samples.begin(), samples.end());
  }
  return all;
}

const std::vector<int> kLight{0};
Progress silent;

TEST(Pilot, LooksAtAllViewsEvenly) {
  for (const bool rendered : {false, true}) {
    const Places capture(24, {200, 150}, rendered);
    std::vector<int> groups(24);
    for (int g = 0; g < 24; ++g) groups[static_cast<std::size_t>(g)] = g;
    const Pilot pilot = drawPilot(capture, groups, kLight, 40000, silent);
    EXPECT_FALSE(pilot.complete);
    EXPECT_GT(pilot.pixels, 20000u);
    EXPECT_LT(pilot.pixels, 60000u);
    std::vector<int> ofView(24, 0);
    for (const float view : channelOf(pilot, 0)) ++ofView.at(static_cast<std::size_t>(view));
    EXPECT_GT(*std::ranges::min_element(ofView), 300) << "no view is left out";
    const std::vector<float> x = channelOf(pilot, 1);
    const std::set<float> columns(x.begin(), x.end());
    EXPECT_EQ(columns.size(), 200u) << "no column is never seen";
  }
}

TEST(Pilot, OfSomeViewsIsOfThoseAlone) {
  const Places capture(6, {40, 30}, false);
  const std::vector<int> groups{1, 4};
  const Pilot pilot = drawPilot(capture, groups, kLight, 1 << 20, silent);
  EXPECT_TRUE(pilot.complete);
  EXPECT_EQ(pilot.pixels, 2u * 40 * 30);
  for (const float view : channelOf(pilot, 0)) ASSERT_TRUE(view == 1 || view == 4);
}

TEST(Pilot, FindsTheLittleThatARenderedViewShows) {
  Places capture(2, {640, 640}, true);
  capture.shown_ = [](int x, int y) { return x == 333 && y == 77 ? 0.25f : 0.0f; };
  const std::vector<int> groups{0, 1};
  const Pilot pilot = drawPilot(capture, groups, kLight, 4096, silent);
  EXPECT_GE(pilot.pixels, 1u);
}

TEST(Pilot, NothingToSeeIsAnError) {
  for (const bool rendered : {false, true}) {
    Places capture(1, {64, 64}, rendered);
    capture.shown_ = [](int, int) { return 0.0f; };
    const std::vector<int> groups{0};
    EXPECT_THROW(drawPilot(capture, groups, kLight, 4096, silent), Error);
  }
}

TEST(Pilot, LittleIsRenderedTwice) {
  const Places photographs(1, {16, 16}, false), scene(1, {16, 16}, true);
  const std::uint64_t pixels = 1'000'000;
  EXPECT_EQ(pilotPixels(photographs, pixels, 4, 1, std::uint64_t{1} << 32), 100'000u);
  EXPECT_GE(pilotPixels(photographs, 240'000, 4, 1, std::uint64_t{1} << 32), 240'000u);
  EXPECT_EQ(pilotPixels(scene, pixels, 4, 1, std::uint64_t{1} << 32), pixels / 12);
  EXPECT_EQ(pilotPixels(scene, 20'000, 4, 1, std::uint64_t{1} << 32), 16'384u);
  EXPECT_EQ(pilotPixels(photographs, pixels, 4, 5, std::uint64_t{1} << 32), 20'000u);
  EXPECT_EQ(pilotPixels(scene, 20'000, 4, 8, std::uint64_t{1} << 32), 16'384u)
      << "every frame is chosen for by itself";
}

}  // namespace
}  // namespace illum
