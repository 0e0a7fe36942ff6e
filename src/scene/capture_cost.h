// What a capture would take, before anything is made for it.
#pragma once

#include <string>

#include "scene/capture_plan.h"

namespace illum {

/// Counted in doubles, so that no count can overflow.
struct CaptureCost {
  double views = 0, pixels = 0;                  ///< pixels of all views together
  double lights = 0, samples = 0, vertices = 0;  ///< vertices of a path: 1 + bounces
  double shadowRays() const { return pixels * lights * samples * vertices; }
  double photographBytes() const { return pixels * lights * 12; }  ///< three floats
};

/// Of the plan as it stands. Windows whose shape follows from the scene count as squares.
CaptureCost costOf(const CapturePlan& plan);

/// "25 views of 65536 pixels x 64 lights x 4 samples x 2 path vertices = 8.4e+08 shadow rays, …"
std::string textOf(const CaptureCost& cost);

/// Throws Error (Fault::Input) with the cost in words where the plan has more than `maxShadowRays`,
/// more than 65536 views or more than 100000 lights.
void checkCost(const CapturePlan& plan, double maxShadowRays);

}  // namespace illum
