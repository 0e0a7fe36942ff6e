// The longest step of building: the planes of one view after another are fitted, coded and written.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "build/plan.h"
#include "build/plane_row.h"
#include "build/tile_writer.h"
#include "encode/object_writer.h"
#include "illum/capture.h"
#include "illum/progress.h"
#include "object/manifest.h"

namespace illum {

class ViewWriter {
 public:
  /// Everything must outlive the writer. `atOnce`: tiles coded side by side.
  ViewWriter(const Capture& capture, const LightChoice& lights, const Plan& plan,
             Manifest& manifest, const EncodeSettings& settings, int atOnce, ObjectWriter& writer,
             Progress& progress);

  /// Writes the tiles of all views and the poster, and the ranges of depths into the manifest.
  /// Views that an earlier run has finished are not read again. Returns the samples that became
  /// codes.
  SampleCounts writeAll();

 private:
  void chooseDepths();
  bool isFinished(int group) const;
  std::optional<CutTile> nextTile();
  void take(const PlaneRow& row);

  const Capture& capture_;
  const Plan& plan_;
  Manifest& manifest_;
  ObjectWriter& writer_;
  Progress& progress_;
  int atOnce_;
  int poster_;            // the group that is shown of the object
  std::deque<int> left_;  // groups that are not written yet
  int nextRow_ = 0;       // of the first of them
  TileWriter tiles_;
  TileQueue queue_;
  LevelPyramid pyramid_;
  RowFitter fitter_;
};

}  // namespace illum
