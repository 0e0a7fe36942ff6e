// Views whose frames are turned alike: they see every light from the same direction, so that one
// basis and one operator serve them all.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "illum/camera.h"
#include "illum/light.h"

namespace illum {

struct TurnedFrame {
  RigidTransform objectFromFrame;  ///< a rotation; the translation is 0
  std::vector<int> groups;         ///< rising

  /// What the lights are in the frame: R^-1 w (docs/conventions.md, "Frames").
  std::vector<DirectionalLight> turned(std::span<const DirectionalLight> lightsInObject) const;
};

/// In the order of their first views.
std::vector<TurnedFrame> framesOf(const std::vector<View>& views);

/// For each view the index of its frame.
std::vector<int> frameOfEachView(const std::vector<TurnedFrame>& frames, std::size_t views);

/// For people: what a frame's views are called.
std::string nameOf(const TurnedFrame& frame, const std::vector<View>& views);

}  // namespace illum
