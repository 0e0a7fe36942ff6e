#include "scene/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace illum {
namespace {

/// A corner of a triangle: 3 * triangle + 0, 1 or 2.
using Corner = std::size_t;

class Smoother {
 public:
  Smoother(TriangleMesh& mesh, double angleRadians)
      : mesh_(mesh), leastCosine_(std::cos(angleRadians)) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vector3 normal = cross(edge(t, 0, 1), edge(t, 0, 2));
      faceNormals_.push_back((1 / length(normal)) * normal);
    }
  }

  void run() {
    std::vector<Corner> corners(3 * mesh_.triangles.size());
    for (Corner c = 0; c < corners.size(); ++c) corners[c] = c;
    std::ranges::sort(corners, [&](Corner a, Corner b) {
      return std::pair(position(a), a) < std::pair(position(b), b);
    });
    std::vector<Vector3> normals(corners.size());
    for (auto first = corners.begin(); first != corners.end();) {
      const auto last = std::find_if(first, corners.end(),
                                     [&](Corner c) { return position(c) != position(*first); });
      smoothAround({first, last}, normals);
      first = last;
    }
    write(normals);
  }

 private:
  std::uint32_t& vertex(Corner c) { return mesh_.triangles[c / 3][c % 3]; }
  const std::array<float, 3>& position(Corner c) {
    return mesh_.positions[mesh_.triangles[c / 3][c % 3]];
  }
  Vector3 edge(std::size_t t, std::size_t from, std::size_t to) {
    const auto& a = position(3 * t + from);
    const auto& b = position(3 * t + to);
    return Vector3{b[0], b[1], b[2]} - Vector3{a[0], a[1], a[2]};
  }
  double angleAt(Corner c) {
    const std::size_t t = c / 3, k = c % 3;
    const Vector3 a = edge(t, k, (k + 1) % 3), b = edge(t, k, (k + 2) % 3);
    return std::atan2(length(cross(a, b)), dot(a, b));
  }

  /// All corners at one point. So many that comparing all pairs would take long are the hub of a
  /// fan, where the mean of all will do.
  void smoothAround(std::span<const Corner> corners, std::vector<Vector3>& normals) {
    constexpr std::size_t kHub = 512;
    std::vector<Vector3> weighted;
    Vector3 all;
    for (const Corner c : corners) {
      weighted.push_back(angleAt(c) * faceNormals_[c / 3]);
      all = all + weighted.back();
    }
    for (const Corner c : corners) {
      const Vector3 own = faceNormals_[c / 3];
      Vector3 sum = all;
      if (corners.size() <= kHub) {
        sum = {};
        for (std::size_t i = 0; i < corners.size(); ++i)
          if (dot(own, faceNormals_[corners[i] / 3]) >= leastCosine_) sum = sum + weighted[i];
      }
      normals[c] = length(sum) > 1e-6 ? (1 / length(sum)) * sum : own;
    }
  }

  /// The vertex of a corner takes its normal; further normals take copies of the vertex.
  void write(const std::vector<Vector3>& normals) {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    const std::size_t before = mesh_.positions.size();
    mesh_.normals.assign(before, {0, 0, 0});
    std::vector<std::uint32_t> nextCopy(before, kNone);
    std::vector<bool> used(before, false);
    for (Corner c = 0; c < normals.size(); ++c) {
      const std::array<float, 3> normal{static_cast<float>(normals[c].x),
                                        static_cast<float>(normals[c].y),
                                        static_cast<float>(normals[c].z)};
      std::uint32_t at = vertex(c);
      while (used[at] && mesh_.normals[at] != normal && nextCopy[at] != kNone) at = nextCopy[at];
      if (used[at] && mesh_.normals[at] != normal) {
        const auto copy = static_cast<std::uint32_t>(mesh_.positions.size());
        nextCopy[at] = copy;
        duplicate(at);
        nextCopy.push_back(kNone);
        used.push_back(false);
        at = copy;
      }
      used[at] = true;
      mesh_.normals[at] = normal;
      vertex(c) = at;
    }
    for (std::size_t v = 0; v < mesh_.normals.size(); ++v)
      if (!used[v]) mesh_.normals[v] = {0, 0, 1};  // of no triangle
  }

  void duplicate(std::uint32_t v) {
    mesh_.positions.push_back(mesh_.positions[v]);
    mesh_.normals.push_back({0, 0, 0});
    if (!mesh_.texcoords.empty()) mesh_.texcoords.push_back(mesh_.texcoords[v]);
    if (!mesh_.colours.empty()) mesh_.colours.push_back(mesh_.colours[v]);
  }

  TriangleMesh& mesh_;
  double leastCosine_;
  std::vector<Vector3> faceNormals_;
};

}  // namespace

void addSmoothNormals(TriangleMesh& mesh, double angleRadians) {
  if (angleRadians > 0) Smoother(mesh, angleRadians).run();
}

}  // namespace illum
