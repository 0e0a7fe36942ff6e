// A matt object in memory: each texel has a normal and an albedo, and its reflectance is known.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "codec/tile.h"
#include "illum/basis_table.h"
#include "object/manifest.h"
#include "relight/tile_planes.h"

namespace illum {

/// One plane a coordinate of the normal: value = b_x n_x + b_y n_y + b_z n_z with b = the light's
/// direction, so the light's cosine, negative where the surface faces away.
struct MattObject {
  LightBasis basis;
  CodingEntry coding;
  PlaneCodes codes;

  TilePlanes planes() const { return {codes, coding.bits}; }

  static constexpr double kRange = 2.0 / 65535;

  explicit MattObject(const std::vector<Vector3>& albedoNormals) {
    BasisTable table(LightDomain::Sphere, 65, 12);
    table.fill([](Direction d, std::span<double> out) {
      const std::array<double, 3> coordinates{d.x(), d.y(), d.z()};
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t c = 0; c < 3; ++c) out[3 * k + c] = k < 3 ? coordinates[k] : 0;
      }
    });
    basis = LightBasis(table, {BasisColour::Kind::Full, {}});
    coding.bits = 16;
    coding.step = kRange;
    coding.offsets = {-1, -1, -1};
    coding.functions = {0, 1, 2};
    codes = {3, {static_cast<int>(albedoNormals.size()), 1}, {}};
    for (const auto coordinate : {&Vector3::x, &Vector3::y, &Vector3::z}) {
      for (const Vector3& n : albedoNormals) {
        codes.values.push_back(
            static_cast<std::uint16_t>(std::lround((n.*coordinate + 1) / kRange)));
      }
    }
  }
};

}  // namespace illum
