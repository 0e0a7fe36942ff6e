// An object beside the photographs that it is judged by, both in the same form.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "illum/capture.h"
#include "illum/object.h"
#include "illum/progress.h"
#include "illum/relight.h"
#include "study/photograph.h"

namespace illum {

/// Some rows under one light, as relit and as photographed: linear RGB over black, and on screen.
struct ComparedBand {
  Picture relit;
  BytePicture relitBytes;
  PhotographBand photograph;
};

/// Relit pictures and photographs side by side. If the object has a mask, both are multiplied by
/// coverage: the relit picture by the object's, the photograph by the capture's (by the object's,
/// if the capture has none).
class Comparison {
 public:
  /// Keeps references. `memoryBytes`: what judging may hold together with the capture; 0 = a
  /// quarter of the machine. Throws Error (Fault::Input) if the sizes differ or there is no light.
  Comparison(const Object& object, const Capture& truth, std::uint64_t memoryBytes);

  const Capture& truth() const { return truth_; }
  /// 1 channel; empty if neither side has a mask.
  const BytePicture& coverage() const { return coverage_; }

  /// Goes down the pictures band by band, and in each band under all `lights` (indices), several at
  /// once. `use(i, band)` gets lights[i]; calls with the same i come one after the other from the
  /// top, others may run at the same time. `progress` advances by one for each call; bandCount() *
  /// lights.size() in all. `keptBytes`: what the caller keeps meanwhile.
  void forEachBand(std::span<const int> lights, std::uint64_t keptBytes, Progress& progress,
                   const std::function<void(std::size_t i, const ComparedBand& band)>& use) const;
  std::uint64_t stepCount() const { return steps_.size(); }

 private:
  ComparedBand compared(int light, const Rectangle& rows) const;
  int lightsAtOnce(std::uint64_t keptBytes) const;

  const Object& object_;
  const Capture& truth_;
  std::vector<Rectangle> steps_;
  std::uint64_t memoryBytes_, tileBytes_;
  Relighter relighter_;
  BytePicture coverage_;
};

}  // namespace illum
