// Points on many discs at once, by vector instructions.
#pragma once

#include <array>

#include "render/direction_batch.h"

namespace illum {

/// Lights that are looked at together, as discs.
struct DiscBatch {
  DirectionBatch centre, across, up;                       ///< orthonormal frames
  alignas(64) std::array<float, kBatch> turnA{}, turnB{};  ///< in [0, 1), of each light's own
};

/// A direction on each of the first `count` discs, even in solid angle over the two numbers of
/// `uniform`, in [0, 1). `height` of a disc is 1 - cos(radius). Entries behind the first `count`
/// may be written.
void drawOnDiscs(const DiscBatch& discs, float height, std::array<float, 2> uniform,
                 std::size_t count, DirectionBatch& out);

}  // namespace illum
