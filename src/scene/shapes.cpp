#include "scene/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace illum {
namespace {

/// Normal of a parametric surface by differences; moves inward from a point in which the surface
/// degenerates.
Vector3 normalAt(const std::function<Vector3(double, double)>& point, double u, double v) {
  constexpr double kStep = 1e-4;
  for (const double inward : {0.0, 2e-3, 1e-2}) {
    const double a = u + inward * (0.5 - u), b = v + inward * (0.5 - v);
    const double u0 = std::max(0.0, a - kStep), u1 = std::min(1.0, a + kStep);
    const double v0 = std::max(0.0, b - kStep), v1 = std::min(1.0, b + kStep);
    const Vector3 du = (1 / (u1 - u0)) * (point(u1, b) - point(u0, b));
    const Vector3 dv = (1 / (v1 - v0)) * (point(a, v1) - point(a, v0));
    const Vector3 normal = cross(du, dv);
    if (length(normal) > 1e-6 * (dot(du, du) + dot(dv, dv))) return (1 / length(normal)) * normal;
  }
  return {0, 0, 1};
}

}  // namespace

std::array<float, 3> floatsOf(Vector3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vector3 vectorOf(const std::array<float, 3>& f) {
  return {f[0], f[1], f[2]};
}

TriangleMesh rectangleMesh(double width, double height) {
  TriangleMesh mesh;
  for (const auto& [u, v] : {std::pair{0.F, 0.F}, {1.F, 0.F}, {1.F, 1.F}, {0.F, 1.F}}) {
    mesh.positions.push_back(floatsOf({(u - 0.5) * width, (v - 0.5) * height, 0}));
    mesh.normals.push_back({0, 0, 1});
    mesh.texcoords.push_back({u, v});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TriangleMesh boxMesh(Vector3 size) {
  TriangleMesh mesh;
  const auto addFace = [&](double width, double height, double depth, const RigidTransform& turn) {
    TriangleMesh face = rectangleMesh(width, height);
    transform(face, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, depth / 2}});
    transform(face, turn);
    append(mesh, face);
  };
  // Rotations written out, so that faces lie exactly in the box's planes.
  addFace(size.x, size.y, size.z, {});
  addFace(size.x, size.y, size.z, {{-1, 0, 0, 0, 1, 0, 0, 0, -1}, {}});
  addFace(size.z, size.y, size.x, {{0, 0, 1, 0, 1, 0, -1, 0, 0}, {}});
  addFace(size.z, size.y, size.x, {{0, 0, -1, 0, 1, 0, 1, 0, 0}, {}});
  addFace(size.x, size.z, size.y, {{1, 0, 0, 0, 0, 1, 0, -1, 0}, {}});
  addFace(size.x, size.z, size.y, {{1, 0, 0, 0, 0, -1, 0, 1, 0}, {}});
  return mesh;
}

TriangleMesh surfaceMesh(const std::function<Vector3(double, double)>& point, int uSteps,
                         int vSteps) {
  TriangleMesh mesh;
  for (int j = 0; j <= vSteps; ++j) {
    for (int i = 0; i <= uSteps; ++i) {
      const double u = static_cast<double>(i) / uSteps, v = static_cast<double>(j) / vSteps;
      mesh.positions.push_back(floatsOf(point(u, v)));
      mesh.normals.push_back(floatsOf(normalAt(point, u, v)));
      mesh.texcoords.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
  }
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j * (uSteps + 1) + i); };
  const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh.positions;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.triangles.push_back({a, b, c});
  };
  for (int j = 0; j < vSteps; ++j) {
    for (int i = 0; i < uSteps; ++i) {
      addTriangle(index(i, j), index(i + 1, j), index(i + 1, j + 1));
      addTriangle(index(i, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  return mesh;
}

TriangleMesh sphereMesh(int steps) {
  constexpr double kPi = std::numbers::pi;
  // Seam and poles are the same point whatever sin and cos of multiples of pi are rounded to.
  TriangleMesh mesh = surfaceMesh(
      [](double u, double v) {
        if (v == 0 || v == 1) return Vector3{0, 2 * v - 1, 0};
        const double azimuth = 2 * kPi * ((u == 1 ? 0 : u) - 0.5), latitude = kPi * (v - 0.5);
        return Vector3{std::sin(azimuth) * std::cos(latitude), std::sin(latitude),
                       std::cos(azimuth) * std::cos(latitude)};
      },
      2 * steps, steps);
  // Its normals are known without differences.
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vector3 p = vectorOf(mesh.positions[i]);
    mesh.normals[i] = floatsOf((1 / length(p)) * p);
  }
  return mesh;
}

void transform(TriangleMesh& mesh, const RigidTransform& objectFromMesh) {
  for (auto& p : mesh.positions) p = floatsOf(objectFromMesh.point(vectorOf(p)));
  for (auto& n : mesh.normals) n = floatsOf(objectFromMesh.vector(vectorOf(n)));
}

void scale(TriangleMesh& mesh, double factor) {
  for (auto& p : mesh.positions) p = floatsOf(factor * vectorOf(p));
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  mesh.texcoords.insert(mesh.texcoords.end(), other.texcoords.begin(), other.texcoords.end());
  mesh.colours.insert(mesh.colours.end(), other.colours.begin(), other.colours.end());
  for (const auto& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace illum
