// What Relighter::prepare makes of lights.
#pragma once

#include <memory>

#include "illum/relight.h"
#include "relight/near_lights.h"
#include "relight/passes.h"
#include "relight/surface.h"

namespace illum {

struct PreparedLights::State {
  Object object;  // keeps the basis that `nearby` refers to
  int group = 0;
  std::shared_ptr<const Illumination> lights;  // as they were given, in the object frame
  double environmentError = 0;
  Passes distant;
  NearLights nearby;
  Surface surface;
};

}  // namespace illum
