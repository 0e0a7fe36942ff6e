// Where a slab stands that has to show a scene: its frame, view points and window.
#pragma once

#include <vector>

#include "scene/capture_plan.h"

namespace illum {

/// The slab that a plan and a scene make. Throws Error where `toward` and `up` determine no frame
/// or a view point stands inside the scene.
LightSlab framedSlab(const SlabPlan& plan, const Scene& scene);

/// Where the i-th slab of a turn stands, as a direction from the object.
Vector3 towardOf(const TurnPlan& plan, int i);

/// The slabs of a turn.
std::vector<LightSlab> framedTurn(const TurnPlan& plan, const Scene& scene);

}  // namespace illum
