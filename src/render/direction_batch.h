// Many directions at once, coordinate by coordinate, as vector instructions want them.
#pragma once

#include <array>
#include <cstddef>

namespace illum {

/// Lights that are looked at together: their rays and values stay in the first-level cache. A
/// multiple of every vector's length.
constexpr std::size_t kBatch = 64;

struct DirectionBatch {
  alignas(64) std::array<float, kBatch> x, y, z;
};

/// What a BSDF says of a batch: value times the cosine, colour by colour, and the density with
/// which `sample` draws the direction.
struct BsdfBatch {
  alignas(64) std::array<float, kBatch> r, g, b, density;
};

}  // namespace illum
