// The lights of a capture as corners of triangles that cover the sphere of directions: between
// samples that are kept themselves (P. Haeberli, "Synthetic Lighting for Photography", 1992) light
// is interpolated linearly on their Delaunay triangulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "illum/vector.h"

namespace illum {

/// Weights of the lights as functions of direction: never negative, of sum 1, continuous, and 1 at
/// a light itself.
///
/// Corners are the lights, and where those leave a gap wider than they can be trusted to close (the
/// lower hemisphere under a dome), also *closing* directions without a picture of their own. Such a
/// one stands for the mean of the lights that an edge joins it to, which is what the paper does
/// below the horizon: from the equator's values to their mean (Wong et al. 1997, section 5).
class LightMesh {
 public:
  using Triangle = std::array<std::uint16_t, 3>;  ///< corners, counter-clockwise from outside

  static constexpr int kMaxLights = 768, kMaxClosing = 64;
  /// Directions nearer to each other than this (length of the chord) are one.
  static constexpr double kSameDirection = 1e-6;

  /// `sites`: unit vectors, `lights` lights and then the closing directions. Untrusted input is
  /// safe: throws Error naming `source` unless the triangles cover the sphere once and are
  /// Delaunay's.
  LightMesh(std::vector<Vector3> sites, int lights, std::vector<Triangle> triangles,
            const std::string& source);

  int lights() const { return lights_; }
  std::span<const Vector3> sites() const { return sites_; }
  std::span<const Triangle> triangles() const { return triangles_; }

  /// A triangle that `d` lies in, and the barycentric coordinates of where its ray meets the
  /// triangle's plane; {site, site, site} with weights {1, 0, 0} at a site.
  struct Place {
    std::array<std::size_t, 3> sites;
    std::array<double, 3> weights;
  };
  Place placeOf(Direction d) const;

  /// The lights that a site stands for, with equal shares: itself if it is one.
  std::span<const std::uint16_t> standIns(std::size_t site) const { return standIns_[site]; }

  /// Calls visit(light, weight) for every light that counts in direction d; a light may come twice.
  template <typename Visit>
  void forEachWeight(Direction d, const Visit& visit) const {
    const Place place = placeOf(d);
    for (std::size_t i = 0; i < 3; ++i) {
      if (place.weights[i] == 0) continue;
      const auto lights = standIns(place.sites[i]);
      const double weight = place.weights[i] / static_cast<double>(lights.size());
      for (const std::uint16_t light : lights) visit(std::size_t{light}, weight);
    }
  }

  /// basis.bin's bytes (docs/format.md, "Directions").
  std::vector<std::byte> encode() const;
  /// Untrusted input is safe. Throws Error naming `source`.
  static LightMesh decode(std::span<const std::byte> bytes, const std::string& source);

 private:
  static constexpr std::size_t kCellsAcross = 32;  // of the chart in which a walk's start is found

  Vector3 corner(std::size_t triangle, std::size_t i) const {
    return sites_[triangles_[triangle][i]];
  }
  std::array<double, 3> coordinates(std::size_t triangle, Vector3 d) const;
  std::size_t triangleAt(Vector3 d, std::size_t start) const;
  void checkSites(const std::string& source) const;
  void joinTriangles(const std::string& source);
  void checkCover(const std::string& source) const;
  void findStandIns();
  void findStarts();

  std::vector<Vector3> sites_;
  int lights_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<std::size_t, 3>> neighbours_;  // beyond the edge opposite to a corner
  std::vector<std::vector<std::uint16_t>> standIns_;
  std::vector<std::size_t> starts_;
};

}  // namespace illum
