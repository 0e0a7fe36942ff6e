// Triangles of simple shapes, for built-in scenes.
#pragma once

#include <functional>
#include <string>

#include "illum/transform.h"
#include "scene/scene.h"

namespace illum {

/// A box about the origin, flat faces.
TriangleMesh boxMesh(Vector3 size);

/// A rectangle in z = 0 about the origin, facing +z; texture coordinates from 0 to 1.
TriangleMesh rectangleMesh(double width, double height);

/// point(u, v) over [0, 1]^2 as (uSteps x vSteps) pairs of triangles with smooth normals, texture
/// coordinates (u, v). Faces the side from which u right and v up are seen. Where the surface
/// closes in itself or ends in a point its normals are continuous too.
TriangleMesh surfaceMesh(const std::function<Vector3(double u, double v)>& point, int uSteps,
                         int vSteps);

/// The unit sphere with poles on y; `steps` from pole to pole, twice as many around. Texture
/// coordinates grow to the right and upward, u = 0.5 in front.
TriangleMesh sphereMesh(int steps);

/// Moves all points.
void transform(TriangleMesh& mesh, const RigidTransform& objectFromMesh);
/// Scales all points about the origin by a positive factor.
void scale(TriangleMesh& mesh, double factor);
/// Adds the triangles of `other`; both have the same kinds of attributes.
void append(TriangleMesh& mesh, const TriangleMesh& other);

std::array<float, 3> floatsOf(Vector3 v);
Vector3 vectorOf(const std::array<float, 3>& f);

}  // namespace illum
