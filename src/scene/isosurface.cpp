#include "scene/isosurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "scene/shapes.h"

namespace illum {
namespace {

constexpr int kBlock = 4;               // grid points along a block
constexpr double kOverestimate = 1.25;  // of distances, as isosurface.h allows
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Distances at the points of a grid, plane by plane along z. Blocks that the surface does not come
/// near have one value, that of their middle.
class SampledField {
 public:
  SampledField(const DistanceFunction& distance, const Bounds& bounds, double cell)
      : distance_(distance), low_(bounds.low), cell_(cell) {
    const Vector3 extent = bounds.high - bounds.low;
    nx = static_cast<int>(std::ceil(extent.x / cell)) + 1;
    ny = static_cast<int>(std::ceil(extent.y / cell)) + 1;
    nz = static_cast<int>(std::ceil(extent.z / cell)) + 1;
  }

  int nx, ny, nz;

  Vector3 point(double i, double j, double k) const {
    return low_ + Vector3{i * cell_, j * cell_, k * cell_};
  }

  /// Values of plane k, rows along x. Ask for planes in rising order.
  std::vector<float> plane(int k) {
    if (k % kBlock == 0) middles(k);
    std::vector<float> values(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
    std::size_t at = 0;
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const float middle = middles_[static_cast<std::size_t>(j / kBlock * blocks() + i / kBlock)];
        values[at++] =
            std::abs(middle) > reach() ? middle : static_cast<float>(distance_(point(i, j, k)));
      }
    }
    return values;
  }

 private:
  int blocks() const { return (nx + kBlock - 1) / kBlock; }
  /// A block and the cells around it lie within this of its middle.
  double reach() const {
    return kOverestimate * std::numbers::sqrt3 * (0.5 * (kBlock - 1) + 1) * cell_;
  }
  void middles(int k) {
    constexpr double kMiddle = 0.5 * (kBlock - 1);
    middles_.clear();
    for (int j = 0; j < ny; j += kBlock) {
      for (int i = 0; i < nx; i += kBlock) {
        const Vector3 p = point(i + kMiddle, j + kMiddle, k + kMiddle);
        middles_.push_back(static_cast<float>(distance_(p)));
      }
    }
  }

  const DistanceFunction& distance_;
  Vector3 low_;
  double cell_;
  std::vector<float> middles_;  // of the blocks of the current planes
};

/// The eight values of a cell, index x + 2 y + 4 z.
using CellValues = std::array<float, 8>;

/// The mean of the points in which the surface crosses the cell's edges, in [0, 1]^3.
std::optional<Vector3> middleOfCrossings(const CellValues& values) {
  Vector3 sum;
  int count = 0;
  for (unsigned a = 0; a < 8; ++a) {
    for (unsigned axis = 1; axis < 8; axis <<= 1) {
      const unsigned b = a | axis;
      if (b == a || (values[a] < 0) == (values[b] < 0)) continue;
      const double t = values[a] / (values[a] - values[b]);
      const auto along = [&](unsigned bit) { return (a & bit) ? 1.0 : (axis == bit ? t : 0.0); };
      sum = sum + Vector3{along(1), along(2), along(4)};
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return (1.0 / count) * sum;
}

/// How the values grow across a cell of side 1, on the whole.
Vector3 slopeOf(const CellValues& values) {
  Vector3 sum;
  for (unsigned a = 0; a < 8; ++a) {
    const auto sign = [&](unsigned bit) { return (a & bit) ? 0.25 : -0.25; };
    sum = sum + values[a] * Vector3{sign(1), sign(2), sign(4)};
  }
  return sum;
}

class SurfaceNet {
 public:
  SurfaceNet(const DistanceFunction& distance, const Bounds& bounds, double cell)
      : distance_(distance), cell_(cell), field_(distance, bounds, cell) {}

  TriangleMesh run() {
    near_ = field_.plane(0);
    below_.assign(near_.size(), kNone);
    for (int k = 0; k + 1 < field_.nz; ++k) {
      far_ = field_.plane(k + 1);
      above_.assign(near_.size(), kNone);
      addVertices(k);
      addFaces();
      std::swap(near_, far_);
      std::swap(below_, above_);
    }
    return std::move(mesh_);
  }

 private:
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(field_.nx) +
           static_cast<std::size_t>(i);
  }

  void addVertices(int k) {
    for (int j = 0; j + 1 < field_.ny; ++j) {
      for (int i = 0; i + 1 < field_.nx; ++i) {
        const std::size_t a = at(i, j), b = at(i, j + 1);
        const CellValues values{near_[a], near_[a + 1], near_[b], near_[b + 1],
                                far_[a],  far_[a + 1],  far_[b],  far_[b + 1]};
        const auto middle = middleOfCrossings(values);
        if (!middle) continue;
        above_[a] = static_cast<std::uint32_t>(mesh_.positions.size());
        addVertex(field_.point(i, j, k), *middle, slopeOf(values));
      }
    }
  }

  /// One Newton step onto the surface, within the cell.
  void addVertex(Vector3 corner, Vector3 inCell, Vector3 slopeInCell) {
    Vector3 p = corner + cell_ * inCell;
    const Vector3 slope = (1 / cell_) * slopeInCell;
    const double squared = dot(slope, slope);
    if (squared > 1e-12) p = p - (distance_(p) / squared) * slope;
    p = {std::clamp(p.x, corner.x, corner.x + cell_), std::clamp(p.y, corner.y, corner.y + cell_),
         std::clamp(p.z, corner.z, corner.z + cell_)};
    mesh_.positions.push_back(floatsOf(p));
    const Vector3 normal = gradient(p);
    const double size = length(normal);
    mesh_.normals.push_back(size > 1e-6 ? floatsOf((1 / size) * normal)
                                        : std::array<float, 3>{0, 0, 1});
  }

  /// By the four corners of a tetrahedron: sum of corner times value.
  Vector3 gradient(Vector3 p) const {
    const double h = 0.3 * cell_;
    const double a = distance_(p + Vector3{h, -h, -h}), b = distance_(p + Vector3{-h, -h, h});
    const double c = distance_(p + Vector3{-h, h, -h}), d = distance_(p + Vector3{h, h, h});
    return (1 / (4 * h)) * Vector3{a - b - c + d, -a - b + c + d, -a + b - c + d};
  }

  /// A face across every edge of the grid that the surface crosses: the edges of plane k along x
  /// and y, which have cells of both layers around them, and those from plane k to k + 1.
  void addFaces() {
    for (int j = 0; j + 1 < field_.ny; ++j) {
      for (int i = 0; i + 1 < field_.nx; ++i) {
        const std::size_t here = at(i, j);
        const bool inside = near_[here] < 0;
        if (j > 0 && inside != (near_[here + 1] < 0))
          addFace({below_[at(i, j - 1)], below_[here], above_[here], above_[at(i, j - 1)]}, inside);
        if (i > 0 && inside != (near_[at(i, j + 1)] < 0))
          addFace({below_[here - 1], above_[here - 1], above_[here], below_[here]}, inside);
        if (i > 0 && j > 0 && inside != (far_[here] < 0))
          addFace({above_[at(i - 1, j - 1)], above_[at(i, j - 1)], above_[here], above_[here - 1]},
                  inside);
      }
    }
  }

  /// Corners around an edge, counter-clockwise seen from its upper end; outside is there if the
  /// lower end is inside. Split along the shorter diagonal.
  void addFace(std::array<std::uint32_t, 4> c, bool lowerInside) {
    if (std::ranges::find(c, kNone) != c.end()) return;  // at the bounds
    if (!lowerInside) std::swap(c[1], c[3]);
    if (squaredDistance(c[0], c[2]) <= squaredDistance(c[1], c[3])) {
      mesh_.triangles.push_back({c[0], c[1], c[2]});
      mesh_.triangles.push_back({c[0], c[2], c[3]});
    } else {
      mesh_.triangles.push_back({c[0], c[1], c[3]});
      mesh_.triangles.push_back({c[1], c[2], c[3]});
    }
  }
  double squaredDistance(std::uint32_t a, std::uint32_t b) const {
    const Vector3 d = vectorOf(mesh_.positions[a]) - vectorOf(mesh_.positions[b]);
    return dot(d, d);
  }

  const DistanceFunction& distance_;
  double cell_;
  SampledField field_;
  std::vector<float> near_, far_;  // of planes k and k + 1
  std::vector<std::uint32_t> below_,
      above_;  // vertices of the cells between planes k - 1, k, k + 1
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh isosurface(const DistanceFunction& distance, const Bounds& bounds, double cell) {
  return SurfaceNet(distance, bounds, cell).run();
}

}  // namespace illum
