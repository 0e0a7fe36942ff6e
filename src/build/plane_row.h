// Rows of tiles of fitted planes, and the coarser levels made from them as they pass.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fit/fit.h"
#include "illum/capture.h"
#include "object/manifest.h"

namespace illum {

/// All planes of one row of tiles of one level: plane k at values[k * size.pixels() + y * width +
/// x].
struct PlaneRow {
  int level = 0, row = 0;
  Size size;
  std::vector<float> values;
  std::vector<float> coverage;  ///< empty without a mask
};

/// Reads row `row` of tiles of level 0 and fits it, in parallel. `bandRows`: see Capture. The
/// reading goes down the picture only.
PlaneRow fitRow(const Capture& capture, std::span<const int> lights, const PlaneOperator& planes,
                const Manifest& manifest, int row);

/// Bytes that fitRow's result takes for the widest row of `manifest`, all levels in flight
/// included.
std::uint64_t planeRowBytes(const Manifest& manifest, int basisPlanes);

/// Makes level l+1 from level l by 2 x 2 averages (weighted by coverage), row of tiles by row of
/// tiles.
class LevelPyramid {
 public:
  using Emit = std::function<void(PlaneRow)>;

  LevelPyramid(const Manifest& manifest, int basisPlanes, Emit emit)
      : manifest_(manifest),
        planes_(basisPlanes),
        emit_(std::move(emit)),
        pending_(static_cast<std::size_t>(manifest.levels)) {}

  /// Takes the rows of level 0 in order; emits each, and every coarser row as soon as it is whole.
  void add(PlaneRow row);

 private:
  void shrinkInto(const PlaneRow& fine, PlaneRow& coarse) const;

  const Manifest& manifest_;
  int planes_;
  Emit emit_;
  std::vector<PlaneRow> pending_;  // by level
};

}  // namespace illum
