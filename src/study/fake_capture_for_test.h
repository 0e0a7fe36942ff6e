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

  FakeCapture(Size size, Transfer transfer, std::vector<LightFileEntry> lights, Sample sample)
      : views_{{"fake", OrthographicView{size}}},
        transfer_(transfer),
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

  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return transfer_; }
  const std::vector<LightFileEntry>& lights() const override { return lights_; }
  bool hasMask() const override { return static_cast<bool>(coverage_); }

  void read(int, const Rectangle& rectangle, std::span<const int> lights,
            std::span<float> samples) const override {
    noteRead(rectangle, lights);
    std::size_t i = 0;
    for (const int light : lights)
      for (int channel = 0; channel < 3; ++channel)
        for (int y = rectangle.y; y < rectangle.bottom(); ++y)
          for (int x = rectangle.x; x < rectangle.right(); ++x)
            samples[i++] = sample_(light, x, y, channel);
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
  /// sequential formats decode all photographs again.
  int backwardReads() const { return backwardReads_; }
  int reads() const { return reads_; }

 private:
  void noteRead(const Rectangle& rectangle, std::span<const int> lights) const {
    const std::scoped_lock lock(mutex_);
    backwardReads_ += rectangle.y > 0 && rectangle.y < lowest_;
    lowest_ = rectangle.y;
    reads_ += static_cast<int>(lights.size());
  }

  std::vector<View> views_;
  Transfer transfer_;
  std::vector<LightFileEntry> lights_;
  Sample sample_;
  Coverage coverage_;
  int bandRows_ = 0;
  mutable std::mutex mutex_;
  mutable int lowest_ = 0, backwardReads_ = 0, reads_ = 0;
};

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
