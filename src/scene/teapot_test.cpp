#include "scene/teapot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/shapes.h"

namespace illum {
namespace {

double sixVolumes(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    sum += dot(vectorOf(mesh.positions[t[0]]),
               cross(vectorOf(mesh.positions[t[1]]), vectorOf(mesh.positions[t[2]])));
  }
  return sum;
}

void expectNormalsAgreeWithFaces(const TriangleMesh& mesh, double least) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vector3 a = vectorOf(mesh.positions[t[0]]);
    const Vector3 face =
        cross(vectorOf(mesh.positions[t[1]]) - a, vectorOf(mesh.positions[t[2]]) - a);
    for (const std::uint32_t corner : t) {
      const Vector3 normal = vectorOf(mesh.normals[corner]);
      EXPECT_NEAR(length(normal), 1, 1e-5);
      EXPECT_GT(dot(normal, face), least * length(face)) << "triangle " << i << " of " << mesh.name;
    }
  }
}

TEST(Teapot, HasItsProportions) {
  EXPECT_EQ(teapotPatches().size(), 32u);
  Scene scene;
  scene.meshes = {teapotMesh(16)};
  const Bounds bounds = boundsOf(scene);
  EXPECT_NEAR(bounds.low.y, 0, 1e-6);
  EXPECT_NEAR(bounds.high.y, 3.15, 1e-6);
  EXPECT_NEAR(bounds.high.z, 2, 0.05) << "the belly";
  EXPECT_NEAR(bounds.low.z, -bounds.high.z, 1e-5) << "symmetric";
  EXPECT_GT(bounds.high.x, 3.2) << "the spout points to +x";
  EXPECT_LT(bounds.low.x, -2.8) << "the handle to -x";
}

TEST(Teapot, FacesOutward) {
  const TriangleMesh mesh = teapotMesh(24);
  EXPECT_GT(sixVolumes(mesh), 0);
  expectNormalsAgreeWithFaces(mesh, 0.3);
}

TEST(Teapot, BodyIsRoundWithinTheErrorOfItsPatches) {
  for (const BezierPatch& patch : teapotPatches()) {
    if (std::abs(patch.control[0][0].y - 0.9) > 1e-9 || patch.control[0][0].z != 2) continue;
    for (double u = 0; u <= 1; u += 0.125) {
      const Vector3 p = patch.point(u, 0);
      EXPECT_NEAR(std::hypot(p.x, p.z), 2, 0.02) << u;
    }
  }
}

TEST(Shapes, BoxIsClosedAndOfItsVolume) {
  const TriangleMesh mesh = boxMesh({1, 2, 3});
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(sixVolumes(mesh) / 6, 6, 1e-6);
  expectNormalsAgreeWithFaces(mesh, 0.999);
}

TEST(Shapes, SurfaceFacesTheSideFromWhichUIsRightAndVIsUp) {
  const TriangleMesh mesh = surfaceMesh([](double u, double v) { return Vector3{u, v, 0}; }, 3, 2);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  for (const auto& n : mesh.normals) EXPECT_NEAR(n[2], 1, 1e-6);
  expectNormalsAgreeWithFaces(mesh, 0.999);
}

}  // namespace
}  // namespace illum
