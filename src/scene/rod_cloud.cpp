#include "scene/rod_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/signed_distance.h"

namespace illum {
namespace {

Vector3 unit(Vector3 v) {
  return (1 / lengthOf(v)) * v;
}

}  // namespace

RodCloud::RodCloud(std::span<const Strand> strands, double blend, double reach)
    : blend_(blend), reach_(reach), cell_(reach / 2) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  bounds_ = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  std::uint32_t number = 0;
  for (const Strand& strand : strands) {
    for (std::size_t i = 0; i + 1 < strand.points.size(); ++i) {
      const Vector3 a = strand.points[i], b = strand.points[i + 1];
      const Vector3 side = unit(cross(b - a, strand.outward));
      rods_.push_back({a, b, strand.radii[i], strand.radii[i + 1], side, unit(cross(side, b - a)),
                       strand.grooves, strand.grooveCount, number});
      const double r = std::max(strand.radii[i], strand.radii[i + 1]) + reach;
      for (const Vector3& p : {a, b}) {
        bounds_.low = {std::min(bounds_.low.x, p.x - r), std::min(bounds_.low.y, p.y - r),
                       std::min(bounds_.low.z, p.z - r)};
        bounds_.high = {std::max(bounds_.high.x, p.x + r), std::max(bounds_.high.y, p.y + r),
                        std::max(bounds_.high.z, p.z + r)};
      }
    }
    ++number;
  }
  nx_ = static_cast<int>((bounds_.high.x - bounds_.low.x) / cell_) + 1;
  ny_ = static_cast<int>((bounds_.high.y - bounds_.low.y) / cell_) + 1;
  nz_ = static_cast<int>((bounds_.high.z - bounds_.low.z) / cell_) + 1;
  cells_.resize(cellOf(0, 0, nz_));
  for (std::uint32_t i = 0; i < rods_.size(); ++i) addTo(i);
}

std::size_t RodCloud::cellOf(int x, int y, int z) const {
  return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) +
          static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(nx_) +
         static_cast<std::size_t>(x);
}

/// To all cells that hold points within reach of the rod.
void RodCloud::addTo(std::uint32_t index) {
  const Rod& rod = rods_[index];
  const double far = reach_ + 0.5 * std::sqrt(3.0) * cell_;  // from a cell's middle
  const double around = std::max(rod.radiusA, rod.radiusB) + rod.grooves + reach_;
  const auto range = [&](double a, double b, double low, int cells) {
    const auto at = [&](double x) { return static_cast<int>(std::floor((x - low) / cell_)); };
    return std::pair(std::max(0, at(std::min(a, b) - around)),
                     std::min(cells - 1, at(std::max(a, b) + around)));
  };
  const auto [x0, x1] = range(rod.a.x, rod.b.x, bounds_.low.x, nx_);
  const auto [y0, y1] = range(rod.a.y, rod.b.y, bounds_.low.y, ny_);
  const auto [z0, z1] = range(rod.a.z, rod.b.z, bounds_.low.z, nz_);
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vector3 middle = bounds_.low + cell_ * Vector3{x + 0.5, y + 0.5, z + 0.5};
        if (distance(rod, middle) <= far) cells_[cellOf(x, y, z)].push_back(index);
      }
    }
  }
}

double RodCloud::distance(const Rod& rod, Vector3 p) {
  const double t = alongSegment(p, rod.a, rod.b);
  const Vector3 across = p - (rod.a + t * (rod.b - rod.a));
  const double plain = lengthOf(across) - (rod.radiusA + t * (rod.radiusB - rod.radiusA));
  if (rod.grooves == 0 || plain > 4 * rod.grooves) return plain - rod.grooves;
  const double angle = std::atan2(dot(across, rod.side), dot(across, rod.up));
  return plain - rod.grooves * std::cos(rod.grooveCount * angle);
}

double RodCloud::distance(Vector3 p) const {
  const Vector3 q = (1 / cell_) * (p - bounds_.low);
  if (!(q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x < nx_ && q.y < ny_ && q.z < nz_)) return reach_;
  double all = reach_, ofStrand = reach_;
  std::uint32_t strand = std::numeric_limits<std::uint32_t>::max();
  for (const std::uint32_t index :
       cells_[cellOf(static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z))]) {
    const Rod& rod = rods_[index];
    if (rod.strand != strand) {
      all = smoothUnion(all, ofStrand, blend_);
      ofStrand = reach_;
      strand = rod.strand;
    }
    ofStrand = std::min(ofStrand, distance(rod, p));
  }
  return smoothUnion(all, ofStrand, blend_);
}

}  // namespace illum
