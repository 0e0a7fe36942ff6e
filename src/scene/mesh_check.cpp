#include "scene/mesh_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "illum/error.h"

namespace illum {
namespace {

constexpr float kFar = 1e9F;

template <typename Numbers>
bool allFinite(const Numbers& numbers) {
  return std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); });
}

template <std::size_t N>
bool withinReach(const std::array<float, N>& p) {
  return std::ranges::all_of(p, [](float x) { return std::abs(x) <= kFar; });  // false for NaN
}

std::string titleOf(const TriangleMesh& mesh, const std::string& source) {
  return mesh.name.empty() ? source : fmt::format("{}: mesh '{}'", source, mesh.name);
}

void checkPositions(const TriangleMesh& mesh, const std::string& title) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto& p = mesh.positions[i];
    if (!withinReach(p))
      throw Error(
          Fault::Input,
          fmt::format("{}: expected finite coordinates within 1e9, found {} {} {} at vertex "
                      "{}",
                      title, p[0], p[1], p[2], i));
  }
}

void checkIndices(const TriangleMesh& mesh, const std::string& title) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t index : mesh.triangles[i]) {
      if (index >= mesh.positions.size())
        throw Error(Fault::Input, fmt::format("{}: expected indices below {}, found {} in triangle "
                                              "{}",
                                              title, mesh.positions.size(), index, i));
    }
  }
}

void checkCount(std::size_t count, const TriangleMesh& mesh, std::string_view what,
                const std::string& title) {
  if (count != 0 && count != mesh.positions.size())
    throw Error(Fault::Input, fmt::format("{}: expected {} for each of {} vertices, found {}",
                                          title, what, mesh.positions.size(), count));
}

/// Twice the area against the rounding of the corners themselves.
bool hasArea(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const auto corner = [&](std::size_t i) {
    const auto& p = mesh.positions[t[i]];
    return Vector3{p[0], p[1], p[2]};
  };
  const Vector3 a = corner(1) - corner(0), b = corner(2) - corner(0);
  const double longest = std::max({length(a), length(b), length(b - a)});
  return length(cross(a, b)) > 1e-9 * longest * longest;
}

void dropDegenerateTriangles(TriangleMesh& mesh, const std::string& title,
                             std::vector<std::string>& remarks) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const auto& t) { return !hasArea(mesh, t); });
  const std::size_t dropped = before - mesh.triangles.size();
  if (dropped > 0)
    remarks.push_back(fmt::format("{}: {} of {} triangles have no area and are left out", title,
                                  dropped, before));
}

bool isNormal(const std::array<float, 3>& n) {
  return allFinite(n) && std::hypot(n[0], n[1], n[2]) > 1e-6F;
}

void checkShading(TriangleMesh& mesh, const std::string& title, std::vector<std::string>& remarks) {
  if (!std::ranges::all_of(mesh.normals, isNormal)) {
    mesh.normals.clear();
    remarks.push_back(fmt::format("{}: some normals are no directions; it is shaded flat", title));
  }
  for (auto& n : mesh.normals) {
    const float size = std::hypot(n[0], n[1], n[2]);
    for (float& x : n) x /= size;
  }
  if (!std::ranges::all_of(mesh.texcoords, allFinite<std::array<float, 2>>)) {
    mesh.texcoords.clear();
    remarks.push_back(
        fmt::format("{}: some texture coordinates are not finite; it has no textures", title));
  }
  for (LinearRgb& colour : mesh.colours) {
    for (float* c : {&colour.r, &colour.g, &colour.b}) {
      if (!std::isfinite(*c))
        throw Error(Fault::Input,
                    fmt::format("{}: expected finite vertex colours, found {}", title, *c));
      *c = std::clamp(*c, 0.0F, 1.0F);
    }
  }
}

}  // namespace

void checkMesh(TriangleMesh& mesh, const std::string& source, std::vector<std::string>& remarks) {
  const std::string title = titleOf(mesh, source);
  checkCount(mesh.normals.size(), mesh, "a normal", title);
  checkCount(mesh.texcoords.size(), mesh, "texture coordinates", title);
  checkCount(mesh.colours.size(), mesh, "a colour", title);
  checkPositions(mesh, title);
  checkIndices(mesh, title);
  dropDegenerateTriangles(mesh, title, remarks);
  checkShading(mesh, title, remarks);
}

void checkCurves(const CurveSet& curves, const std::string& source) {
  const std::string title =
      curves.name.empty() ? source : fmt::format("{}: hair '{}'", source, curves.name);
  for (std::size_t i = 0; i < curves.points.size(); ++i) {
    const auto& p = curves.points[i];
    if (!withinReach(p) || !(p[3] >= 0))
      throw Error(Fault::Input,
                  fmt::format("{}: expected finite points within 1e9 and radii from 0, found {} {} "
                              "{} and {} at point {}",
                              title, p[0], p[1], p[2], p[3], i));
  }
  for (std::size_t i = 0; i < curves.firstPoints.size(); ++i) {
    const std::size_t end =
        i + 1 < curves.firstPoints.size() ? curves.firstPoints[i + 1] : curves.points.size();
    if (curves.firstPoints[i] + std::size_t{4} > end || end > curves.points.size())
      throw Error(Fault::Input, fmt::format("{}: expected at least 4 points to a hair, found "
                                            "another number in hair {}",
                                            title, i));
  }
}

}  // namespace illum
