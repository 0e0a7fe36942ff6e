// Light sources. (Point, spot and environment sources join here.)
#pragma once

#include "illum/colour.h"
#include "illum/vector.h"

namespace illum {

/// Parallel light. Intensity 1 reproduces the photograph that was taken under this direction.
struct DirectionalLight {
  Direction toLight;
  LinearRgb intensity{1, 1, 1};
};

}  // namespace illum
