#include "fit/spherical_delaunay.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

namespace illum {
namespace {

// Coordinates are rounded to multiples of 2^-38, for which the sign of a tetrahedron's volume is
// exact in 128 bits: differences have 40 bits, products of three 120, their sum 123. So the hull is
// exactly that of its corners, whatever circles or planes the lights lie on; the rounding, 4e-12,
// is less than what makes a corner of the nearest distinct lights (kDistinctRadians^2 /
// 8, 1.2e-11).
constexpr double kScale = 0x1p38;
__extension__ using Wide = __int128;

struct Lattice {
  std::int64_t x = 0, y = 0, z = 0;
  friend Lattice operator-(Lattice a, Lattice b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};

Lattice rounded(Vector3 v) {
  return {std::llround(v.x * kScale), std::llround(v.y * kScale), std::llround(v.z * kScale)};
}

// Six times the volume of the tetrahedron; positive if p sees a, b, c counter-clockwise.
Wide visibility(Lattice a, Lattice b, Lattice c, Lattice p) {
  const Lattice u = b - a, v = c - a, w = p - a;
  return Wide{w.x} * (Wide{u.y} * v.z - Wide{u.z} * v.y) +
         Wide{w.y} * (Wide{u.z} * v.x - Wide{u.x} * v.z) +
         Wide{w.z} * (Wide{u.x} * v.y - Wide{u.y} * v.x);
}

Vector3 unit(Vector3 v) {
  return (1 / length(v)) * v;
}

// A convex hull that grows point by point (M. Kallay 1984, "The complexity of incremental convex
// hull algorithms"): what the new point sees is taken away, and the rim is joined to it.
class Hull {
 public:
  using Triangle = LightMesh::Triangle;

  /// `tetrahedron`: four points that are not in a plane.
  Hull(const std::vector<Vector3>& points, std::array<std::size_t, 4> tetrahedron) {
    for (const Vector3& point : points) points_.push_back(rounded(point));
    auto [a, b, c, d] = tetrahedron;
    if (visibility(points_[a], points_[b], points_[c], points_[d]) > 0) std::swap(b, c);
    addTriangle(a, b, c);
    addTriangle(a, d, b);
    addTriangle(b, d, c);
    addTriangle(c, d, a);
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (p != a && p != b && p != c && p != d) join(p);
  }

  void add(Vector3 point) {
    points_.push_back(rounded(point));
    join(points_.size() - 1);
  }

  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  using Edge = std::pair<std::uint16_t, std::uint16_t>;

  void addTriangle(std::size_t a, std::size_t b, std::size_t c) {
    triangles_.push_back({static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                          static_cast<std::uint16_t>(c)});
  }

  void join(std::size_t p) {
    std::vector<Edge> edges;
    const auto sees = [&](const Triangle& t) {
      return visibility(points_[t[0]], points_[t[1]], points_[t[2]], points_[p]) > 0;
    };
    const auto hidden = std::stable_partition(triangles_.begin(), triangles_.end(),
                                              [&](const Triangle& t) { return !sees(t); });
    for (auto t = hidden; t != triangles_.end(); ++t)
      for (std::size_t i = 0; i < 3; ++i) edges.emplace_back((*t)[i], (*t)[(i + 1) % 3]);
    triangles_.erase(hidden, triangles_.end());
    std::sort(edges.begin(), edges.end());
    for (const Edge& edge : edges)
      if (!std::binary_search(edges.begin(), edges.end(), Edge{edge.second, edge.first}))
        addTriangle(edge.first, edge.second, p);
  }

  std::vector<Lattice> points_;
  std::vector<Triangle> triangles_;
};

// Lights that lie on a line or in a plane, but for about two degrees, say nothing about what is
// beside it.
constexpr double kFlat = 0.03;

template <typename Measure>
std::size_t largest(const std::vector<Vector3>& points, const Measure& measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (measure(points[i]) > measure(points[best])) best = i;
  return best;
}

// Names four sites that are not in a plane, not even nearly, and adds closing directions where
// there are none such.
std::array<std::size_t, 4> startingTetrahedron(std::vector<Vector3>& sites) {
  const Vector3 first = sites.front();
  const auto sine = [&](Vector3 v) { return length(cross(first, v)); };
  if (sine(sites[largest(sites, sine)]) < kFlat) {  // one place, and perhaps its antipode
    const Vector3 axis = std::abs(first.x) < 0.6 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    const Vector3 aside = unit(cross(first, axis)), up = cross(first, aside);
    for (const Vector3 v : {aside, -1 * aside, up, -1 * up}) sites.push_back(v);
  }
  const std::size_t second = largest(sites, sine);
  const Vector3 chord = sites[second] - first;
  const auto area = [&](Vector3 v) { return length(cross(chord, v - first)); };
  if (area(sites[largest(sites, area)]) < kFlat) {  // two places
    const Vector3 normal = unit(cross(first, sites[second]));
    sites.push_back(normal);
    sites.push_back(-1 * normal);
  }
  const std::size_t third = largest(sites, area);
  Vector3 axis = unit(cross(chord, sites[third] - first));
  if (dot(axis, first) < 0) axis = -1 * axis;
  const auto distance = [&](Vector3 v) { return std::abs(dot(axis, v - first)); };
  // A circle, which leaves more than a hemisphere on its other side.
  if (distance(sites[largest(sites, distance)]) < kFlat) sites.push_back(-1 * axis);
  return {0, second, third, largest(sites, distance)};
}

// The middle of the widest circle that no site is in, and its radius' cosine.
std::pair<Vector3, double> widestEmptyCircle(const std::vector<Vector3>& sites,
                                             const std::vector<LightMesh::Triangle>& triangles) {
  std::pair<Vector3, double> widest{{}, 1};
  for (const LightMesh::Triangle& t : triangles) {
    const Vector3 a = sites[t[0]];
    const Vector3 middle = unit(cross(sites[t[1]] - a, sites[t[2]] - a));
    if (dot(middle, a) < widest.second) widest = {middle, dot(middle, a)};
  }
  return widest;
}

}  // namespace

LightMesh delaunayMesh(std::span<const Direction> lights) {
  assert(!lights.empty() && lights.size() <= LightMesh::kMaxLights);
  std::vector<Vector3> sites;
  for (const Direction& light : lights) sites.push_back(light.vector());
  const auto tetrahedron = startingTetrahedron(sites);
  Hull hull(sites, tetrahedron);
  const std::size_t most = lights.size() + LightMesh::kMaxClosing;
  while (sites.size() < most) {
    const auto [middle, cosine] = widestEmptyCircle(sites, hull.triangles());
    if (cosine >= std::cos(kGapRadians)) break;
    sites.push_back(middle);
    hull.add(middle);
  }
  return {std::move(sites), static_cast<int>(lights.size()), hull.triangles(), "light directions"};
}

std::vector<int> firstOfSame(std::span<const Direction> lights) {
  std::vector<int> first(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto same = std::find_if(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const Direction& earlier) {
                                     return angleRadians(earlier, lights[i]) < kDistinctRadians;
                                   });
    first[i] = static_cast<int>(same - lights.begin());
  }
  return first;
}

}  // namespace illum
