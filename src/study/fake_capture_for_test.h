// A capture in memory, for tests: any function of light and place.
#pragma once

#include <algorithm>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "illum/capture.h"

namespace illum {

class FakeCapture : public Capture {
 public:
  /// A sample: light (index), x, y, channel.
  using Sample = std::function<float(int, int, int, int)>;
  using Coverage = std::function<float(int, int)>;
  /// A sample: view, light (indices), x, y, channel.
  using ViewSample = std::function<float(int, int, int, int, int)>;

  FakeCapture(Size size, Transfer transfer, std::vector<LightFileEntry> lights, Sample sample)
      : views_{{"fake", OrthographicView{size}}},
        transfer_(transfer),
        lights_(std::move(lights)),
        sample_([sample = std::move(sample)](int, int light, int x, int y, int channel) {
          return sample(light, x, y, channel);
        }) {}
  FakeCapture(std::vector<View> views, std::vector<LightFileEntry> lights, ViewSample sample)
      : views_(std::move(views)),
        transfer_(Transfer::Display),
        lights_(std::move(lights)),
        sample_(std::move(sample)) {}

  FakeCapture& withMask(Coverage coverage) {
    coverage_ = std::move(coverage);
    return *this;
  }
  FakeCapture& withBandRows(int rows) {
    bandRows_ = rows;
    return *this;
  }

  FakeCapture& asRendered() {
    rendered_ = true;
    return *this;
  }

  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return transfer_; }
  const std::vector<LightFileEntry>& lights() const override { return lights_; }
  bool hasMask() const override { return static_cast<bool>(coverage_); }
  bool isRendered() const override { return rendered_; }

  void read(int view, const Rectangle& rectangle, std::span<const int> lights,
            std::span<float> samples) const override {
    noteRead(view, rectangle, lights);
    std::size_t i = 0;
    for (const int light : lights)
      for (int channel = 0; channel < 3; ++channel)
        for (int y = rectangle.y; y < rectangle.bottom(); ++y)
          for (int x = rectangle.x; x < rectangle.right(); ++x)
            samples[i++] = sample_(view, light, x, y, channel);
  }
  void readMask(int, const Rectangle& rectangle, std::span<float> coverage) const override {
    std::size_t i = 0;
    for (int y = rectangle.y; y < rectangle.bottom(); ++y)
      for (int x = rectangle.x; x < rectangle.right(); ++x) coverage[i++] = coverage_(x, y);
  }

  int bandRows() const override { return bandRows_ > 0 ? bandRows_ : size().height; }
  std::uint64_t residentBytes() const override { return 0; }
  std::string fingerprint() const override { return "fake"; }

  /// Reads that began above the lowest rows so far, unless at the very top: each would make
  /// sequential formats decode all photographs again. So would going back to an earlier view.
  int backwardReads() const { return backwardReads_; }
  int reads() const { return reads_; }
  /// The fewest and the most lights that were asked for at once.
  std::pair<int, int> lightsOfReads() const { return {fewest_, most_}; }

 private:
  void noteRead(int view, const Rectangle& rectangle, std::span<const int> lights) const {
    const std::scoped_lock lock(mutex_);
    backwardReads_ += view < view_ || (view == view_ && rectangle.y > 0 && rectangle.y < lowest_);
    view_ = view;
    lowest_ = rectangle.y;
    const auto asked = static_cast<int>(lights.size());
    reads_ += asked;
    fewest_ = fewest_ == 0 ? asked : std::min(fewest_, asked);
    most_ = std::max(most_, asked);
  }

  std::vector<View> views_;
  Transfer transfer_;
  std::vector<LightFileEntry> lights_;
  ViewSample sample_;
  Coverage coverage_;
  int bandRows_ = 0;
  bool rendered_ = false;
  mutable std::mutex mutex_;
  mutable int view_ = 0, lowest_ = 0, backwardReads_ = 0, reads_ = 0, fewest_ = 0, most_ = 0;
};

/// `count` cameras side by side, named front0, front1, ...; each picture two pixels wider than the
/// one before.
inline std::vector<View> rowOfCameras(int count, Size size) {
  std::vector<View> views;
  for (int i = 0; i < count; ++i) {
    PinholeCamera camera;
    camera.objectFromCamera.translation = {0.5 * i, 0, 4};
    camera.focalX = camera.focalY = size.width;
    camera.size = {size.width + 2 * i, size.height};
    camera.centre = {0.5 * camera.size.width, 0.5 * size.height};
    views.push_back({"front" + std::to_string(i), camera});
  }
  return views;
}

/// `count` lights around the optical axis, 45 degrees high, named light0.png, light1.png, ...
inline std::vector<LightFileEntry> ringOfLights(int count, LinearRgb intensity = {1, 1, 1}) {
  std::vector<LightFileEntry> lights;
  for (int i = 0; i < count; ++i) {
    const Direction toLight =
        Direction::fromAngles(0.7853981633974483, 6.283185307179586 * i / count);
    lights.push_back({"light" + std::to_string(i) + ".png", {toLight, intensity}, i + 1});
  }
  return lights;
}

}  // namespace illum
