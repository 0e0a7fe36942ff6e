// A sculpted head and shoulders, made up from smoothly joined ellipsoids and rods.
#pragma once

#include <functional>
#include <vector>

#include "illum/vector.h"
#include "scene/rod_cloud.h"

namespace illum {

// The head's own frame: middle of the skull near the origin, chin at y = -1, crown at y = 1, the
// face looks along +z.

/// Head and the beginning of the neck, without hair.
double headDistance(Vector3 p);

/// Locks that lie on the head, combed back from the forehead.
std::vector<Strand> hairLocks();

// The bust's frame: the head's, but the head turned and bent in it.

/// Neck, shoulders and chest, cut below by a bow.
double torsoDistance(Vector3 p);

/// Folds of the cloth around the shoulders.
std::vector<Strand> clothFolds();

/// The foot that the bust stands on.
double socleDistance(Vector3 p);

/// The whole, a signed distance for isosurface().
std::function<double(Vector3)> bustDistance();

}  // namespace illum
