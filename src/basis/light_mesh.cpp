#include "basis/light_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "illum/error.h"

namespace illum {
namespace {

// How far rounding may put a direction out of the triangle that it lies in.
constexpr double kOutside = 1e-14;
// Thinner triangles have no inside that double precision could tell.
constexpr double kLeastVolume = 1e-18;
// How far a corner may stand out of the plane of a triangle that is Delaunay's: four lights of a
// ring lie on one circle, but for rounding.
constexpr double kCoplanar = 1e-9;

double volume(Vector3 a, Vector3 b, Vector3 c) {
  return dot(a, cross(b, c));
}

// A. Van Oosterom, J. Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solidAngle(Vector3 a, Vector3 b, Vector3 c) {
  return 2 * std::atan2(volume(a, b, c), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

// The octahedron's faces unfolded into a square: cheap, and any cell will do to start from.
std::size_t octahedralCell(Vector3 d, std::size_t across) {
  const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  double u = d.x / sum, v = d.y / sum;
  if (d.z < 0) {
    const double folded = std::copysign(1 - std::abs(v), u);
    v = std::copysign(1 - std::abs(u), v);
    u = folded;
  }
  const auto index = [across](double t) {
    return std::min(across - 1,
                    static_cast<std::size_t>((t + 1) / 2 * static_cast<double>(across)));
  };
  return index(v) * across + index(u);
}

// Inverse, of a cell's middle; not normalised.
Vector3 cellMiddle(std::size_t cell, std::size_t across) {
  const auto coordinate = [across](std::size_t i) {
    return (2 * static_cast<double>(i) + 1) / static_cast<double>(across) - 1;
  };
  const double u = coordinate(cell % across), v = coordinate(cell / across);
  const double z = 1 - std::abs(u) - std::abs(v);
  if (z >= 0) return {u, v, z};
  return {std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v), z};
}

}  // namespace

LightMesh::LightMesh(std::vector<Vector3> sites, int lights, std::vector<Triangle> triangles,
                     const std::string& source)
    : sites_(std::move(sites)), lights_(lights), triangles_(std::move(triangles)) {
  checkSites(source);
  joinTriangles(source);
  checkCover(source);
  findStandIns();
  findStarts();
}

void LightMesh::checkSites(const std::string& source) const {
  const int closing = static_cast<int>(sites_.size()) - lights_;
  if (lights_ < 1 || lights_ > kMaxLights || closing < 0 || closing > kMaxClosing)
    throw inputError(source, "1 to 768 lights and at most 64 closing directions",
                     std::to_string(lights_) + " and " + std::to_string(closing));
  if (sites_.size() < 4 || triangles_.size() != 2 * sites_.size() - 4)
    throw inputError(source, "as many triangles as cover the sphere",
                     std::to_string(triangles_.size()) + " for " + std::to_string(sites_.size()) +
                         " directions");
  for (const Vector3& site : sites_)
    if (!(std::abs(length(site) - 1) < 1e-9))
      throw inputError(source, "directions of length 1", std::to_string(length(site)));
}

// Every edge belongs to two triangles, once in each sense. That no site is left without a triangle
// follows from their number (checkSites) by V - E + T = 2, once they are known to cover the sphere.
void LightMesh::joinTriangles(const std::string& source) {
  std::map<std::pair<int, int>, std::pair<std::size_t, std::size_t>> edges;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint16_t from = triangles_[t][(i + 1) % 3], to = triangles_[t][(i + 2) % 3];
      if (from >= sites_.size())
        throw inputError(source, "corners below " + std::to_string(sites_.size()),
                         std::to_string(from));
      if (!edges.emplace(std::pair{from, to}, std::pair{t, i}).second)
        throw inputError(source, "triangles that do not overlap", "an edge of two on one side");
    }
  }
  neighbours_.resize(triangles_.size());
  for (const auto& [edge, place] : edges) {
    const auto other = edges.find({edge.second, edge.first});
    if (other == edges.end())
      throw inputError(source, "triangles that close the sphere", "an edge of one alone");
    neighbours_[place.first][place.second] = other->second.first;
  }
}

// Seen from the middle, all triangles turn the same way, and together they fill 4 pi: so every
// direction lies in exactly one. Delaunay's are those beyond whose plane no corner lies; where that
// holds across every edge, it holds everywhere.
void LightMesh::checkCover(const std::string& source) const {
  double sum = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Vector3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    if (!(volume(a, b, c) > kLeastVolume))
      throw inputError(source, "triangles with their corners counter-clockwise", "another");
    sum += solidAngle(a, b, c);
    Vector3 normal = cross(b - a, c - a);
    normal = (1 / length(normal)) * normal;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::uint16_t site : triangles_[neighbours_[t][i]])
        if (dot(normal, sites_[site] - a) > kCoplanar)
          throw inputError(source, "Delaunay's triangles", "a corner within another's circle");
    }
  }
  if (std::abs(sum - 4 * std::numbers::pi) > 1e-6)
    throw inputError(source, "triangles that cover the sphere once", std::to_string(sum) + " sr");
}

void LightMesh::findStandIns() {
  standIns_.resize(sites_.size());
  const auto count = static_cast<std::size_t>(lights_);
  for (std::size_t site = 0; site < count; ++site)
    standIns_[site] = {static_cast<std::uint16_t>(site)};
  for (const Triangle& triangle : triangles_) {
    for (const std::uint16_t site : triangle) {
      if (site < count) continue;
      // Each neighbour once: an edge out of the site stands in one triangle only.
      const auto at = std::find(triangle.begin(), triangle.end(), site) - triangle.begin();
      const std::uint16_t next = triangle[static_cast<std::size_t>(at + 1) % 3];
      if (next < count) standIns_[site].push_back(next);
    }
  }
  std::vector<std::uint16_t> all(count);
  std::iota(all.begin(), all.end(), std::uint16_t{0});
  for (auto& lights : standIns_) {
    if (lights.empty()) lights = all;
    std::sort(lights.begin(), lights.end());
  }
}

void LightMesh::findStarts() {
  starts_.resize(kCellsAcross * kCellsAcross);
  std::size_t start = 0;
  for (std::size_t cell = 0; cell < starts_.size(); ++cell) {
    start = triangleAt(cellMiddle(cell, kCellsAcross), start);
    starts_[cell] = start;
  }
}

// Up to their common factor, the coordinates of d = sum_i w_i corner_i by Cramer's rule.
std::array<double, 3> LightMesh::coordinates(std::size_t triangle, Vector3 d) const {
  const Vector3 a = corner(triangle, 0), b = corner(triangle, 1), c = corner(triangle, 2);
  return {volume(d, b, c), volume(a, d, c), volume(a, b, d)};
}

// Walks toward d, over the edge that d lies farthest beyond. In Delaunay's triangulation such walks
// end (O. Devillers, S. Pion, M. Teillaud, "Walking in a triangulation", 2002); should rounding
// lead one astray, the triangle is searched.
std::size_t LightMesh::triangleAt(Vector3 d, std::size_t start) const {
  const auto least = [&](std::size_t triangle) {
    const auto w = coordinates(triangle, d);
    const auto lowest = std::min_element(w.begin(), w.end());
    return std::pair{*lowest, static_cast<std::size_t>(lowest - w.begin())};
  };
  std::size_t triangle = start;
  for (std::size_t step = 0; step < triangles_.size(); ++step) {
    const auto [lowest, edge] = least(triangle);
    if (lowest >= -kOutside) return triangle;
    triangle = neighbours_[triangle][edge];
  }
  for (std::size_t other = 0; other < triangles_.size(); ++other)
    if (least(other).first > least(triangle).first) triangle = other;
  return triangle;
}

LightMesh::Place LightMesh::placeOf(Direction d) const {
  const Vector3 v = d.vector();
  const std::size_t triangle = triangleAt(v, starts_[octahedralCell(v, kCellsAcross)]);
  Place place;
  place.weights = coordinates(triangle, v);
  double sum = 0;
  for (double& weight : place.weights) sum += weight = std::max(weight, 0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t site = triangles_[triangle][i];
    if (length(sites_[site] - v) < kSameDirection) return {{site, site, site}, {1, 0, 0}};
    place.sites[i] = site;
    place.weights[i] /= sum;
  }
  return place;
}

}  // namespace illum
