// One function for each built-in scene, each in a file of its own.
#pragma once

#include "scene/capture_plan.h"
#include "scene/scene.h"

namespace illum {

struct PlannedScene {
  Scene scene;
  CapturePlan plan;
};

PlannedScene boxOnPlane();
PlannedScene utahTeapot();
PlannedScene sculptedBust();
PlannedScene cornellBox();
PlannedScene furryBear();
PlannedScene wornCoin();

}  // namespace illum
