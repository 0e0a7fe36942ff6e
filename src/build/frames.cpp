#include "build/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace illum {
namespace {

/// Frames that were computed on different ways differ in their last bits. Basis tables are far
/// coarser than that.
bool isAlike(const RigidTransform& a, const RigidTransform& b) {
  constexpr double kRounding = 1e-9;
  return std::ranges::equal(a.rotation, b.rotation,
                            [](double x, double y) { return std::abs(x - y) <= kRounding; });
}

}  // namespace

std::vector<DirectionalLight> TurnedFrame::turned(
    std::span<const DirectionalLight> lightsInObject) const {
  const RigidTransform frameFromObject = inverse(objectFromFrame);
  std::vector<DirectionalLight> lights(lightsInObject.begin(), lightsInObject.end());
  // Untouched where nothing is turned: rounding would be a difference to no purpose.
  if (objectFromFrame == RigidTransform()) return lights;
  for (DirectionalLight& light : lights) light.toLight = frameFromObject.direction(light.toLight);
  return lights;
}

std::vector<TurnedFrame> framesOf(const std::vector<View>& views) {
  std::vector<TurnedFrame> frames;
  for (std::size_t g = 0; g < views.size(); ++g) {
    RigidTransform turn = objectFromGroup(views[g].geometry);
    turn.translation = {};
    auto known = std::ranges::find_if(
        frames, [&](const TurnedFrame& frame) { return isAlike(frame.objectFromFrame, turn); });
    if (known == frames.end()) known = frames.insert(frames.end(), {turn, {}});
    known->groups.push_back(static_cast<int>(g));
  }
  return frames;
}

std::vector<int> frameOfEachView(const std::vector<TurnedFrame>& frames, std::size_t views) {
  std::vector<int> frameOf(views, 0);
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (const int group : frames[f].groups)
      frameOf[static_cast<std::size_t>(group)] = static_cast<int>(f);
  return frameOf;
}

std::string nameOf(const TurnedFrame& frame, const std::vector<View>& views) {
  const View& first = views[static_cast<std::size_t>(frame.groups.front())];
  const auto* slab = std::get_if<SlabView>(&first.geometry);
  return fmt::format("{} ({} view{})", slab != nullptr ? slab->slab.name : first.name,
                     frame.groups.size(), frame.groups.size() == 1 ? "" : "s");
}

}  // namespace illum
