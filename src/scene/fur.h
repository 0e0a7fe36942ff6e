// Fur on bodies made up of ellipsoids.
#pragma once

#include <cstdint>
#include <span>

#include "illum/transform.h"
#include "scene/scene.h"

namespace illum {

struct FurryPart {
  RigidTransform objectFromPart;
  Vector3 radii;  ///< along the part's axes
  double hairLength = 0.1;
  LinearRgb colour{1, 1, 1};  ///< of its hairs
};

/// Skin of a part.
TriangleMesh skinMesh(const FurryPart& part, int steps);

/// How far a point is from the surface of a part, about; negative inside.
double distanceFrom(const FurryPart& part, Vector3 point);

/// `count` hairs of material 0, evenly spread over the surfaces of the parts, none where a part or
/// one of `bald` covers the skin. They lean down and bend under their weight, in tufts. The same
/// for a seed every time.
CurveSet furOn(std::span<const FurryPart> parts, std::span<const FurryPart> bald, int count,
               std::uint64_t seed);

}  // namespace illum
