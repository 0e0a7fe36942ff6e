// Rows of tiles of fitted planes, and the coarser levels made from them as they pass.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/unset_vector.h"
#include "fit/byte_planes.h"
#include "fit/fit.h"
#include "illum/capture.h"
#include "object/manifest.h"

namespace illum {

/// All planes of one row of tiles of one level of a group: plane k at values[k * size.pixels() + y
/// * width + x].
struct PlaneRow {
  int group = 0, level = 0, row = 0;
  Size size;
  UnsetVector<float> values;
  std::vector<float> coverage;  ///< empty without a mask
  std::vector<float> depth;     ///< infinity where nothing is; empty if the group has none
};

/// Fits rows of tiles of level 0. Buffers are kept from row to row: clearing fresh pages took a
/// quarter of the time (docs/performance.md).
class RowFitter {
 public:
  /// `operators`: one a basis of the manifest. All must outlive the fitter. `progress` advances by
  /// the number of pixels fitted.
  RowFitter(const Capture& capture, std::span<const int> lights,
            std::vector<const PlaneOperator*> operators, const Manifest& manifest,
            Progress& progress);
  ~RowFitter();

  /// Reads and fits row `row` of a group, in parallel. Rows are asked for from the top down: a
  /// sequential capture would have to go back otherwise. What is returned holds until the next
  /// call.
  const PlaneRow& fit(int group, int row);

 private:
  struct Scratch;
  struct State;
  std::size_t basisOf(int group) const;
  void readPlanes(const Rectangle& patch, Scratch& scratch) const;
  void fitPatch(const Rectangle& patch, int top, Scratch& scratch);

  const Capture& capture_;
  std::span<const int> lights_;
  std::vector<const PlaneOperator*> operators_;
  std::vector<BytePlanes> byteOperators_;  ///< of captures whose samples are bytes; else empty
  const Manifest& manifest_;
  Progress& progress_;
  PlaneRow row_;
  std::unique_ptr<State> state_;
};

/// Bytes that fitted rows take for the largest row of any group, all levels in flight included.
/// `planesOfBases`: of each basis of the manifest.
std::uint64_t planeRowBytes(const Manifest& manifest, std::span<const int> planesOfBases);

/// Makes level l+1 from level l by 2 x 2 averages (weighted by coverage; of depths the median), row
/// of tiles by row of tiles.
class LevelPyramid {
 public:
  using Emit = std::function<void(const PlaneRow&)>;

  LevelPyramid(const Manifest& manifest, Emit emit) : manifest_(manifest), emit_(std::move(emit)) {}

  /// Takes the rows of level 0 of a group in order, and of one group after another; emits each,
  /// and every coarser row as soon as it is whole.
  void add(const PlaneRow& row);

 private:
  void shrinkInto(const PlaneRow& fine, PlaneRow& coarse) const;

  const Manifest& manifest_;
  Emit emit_;
  std::vector<PlaneRow> pending_;  // by level; their buffers are used again
};

}  // namespace illum
