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

/// A view of a capture, and the object's view that shows the same: indices.
struct ViewPair {
  int truth = 0, object = 0;
};

/// A pair for each view of `truth`, in its order. The name says which view of the object is meant;
/// where both have one view only, that is the one. Throws Error (Fault::Input) if there is no such
/// view, or one of another size or place, or no light.
std::vector<ViewPair> comparableViews(const Object& object, const Capture& truth);

/// Relit pictures and photographs of one view side by side. If the object has a mask, both are
/// multiplied by coverage: the relit picture by the object's, the photograph by the capture's (by
/// the object's, if the capture has none).
class Comparison {
 public:
  /// Keeps references. `view`: one of comparableViews(). `memoryBytes`: what judging may hold
  /// together with the capture; 0 = a quarter of the machine.
  Comparison(const Object& object, const Capture& truth, ViewPair view, std::uint64_t memoryBytes);

  const Capture& truth() const { return truth_; }
  const ViewPair& view() const { return view_; }
  Size size() const { return truth_.size(view_.truth); }
  /// 1 channel; empty if neither side has a mask.
  const BytePicture& coverage() const { return coverage_; }

  /// Goes down the pictures band by band, and in each band under all `lights` (indices), several at
  /// once. A rendered capture is read for as many of them together as memory allows, since its
  /// lights share their paths. `use(i, band)` gets lights[i]; calls with the same i come one after
  /// the other from the top, others may run at the same time. `progress` advances by one for each
  /// call; bandCount() * lights.size() in all. `keptBytes`: what the caller keeps meanwhile.
  void forEachBand(std::span<const int> lights, std::uint64_t keptBytes, Progress& progress,
                   const std::function<void(std::size_t i, const ComparedBand& band)>& use) const;
  std::uint64_t stepCount() const { return steps_.size(); }

 private:
  /// `samples`: what the capture gave for this light; empty if it was not read yet.
  ComparedBand compared(int light, const Rectangle& rows, std::span<const float> samples) const;
  std::vector<float> rendered(std::span<const int> lights, const Rectangle& rows) const;
  struct AtOnce {
    std::size_t read = 1;  ///< lights that the samples of a step are held of
    int compared = 1;      ///< threads that each hold one light's pictures
  };
  AtOnce lightsAtOnce(std::size_t lights, std::uint64_t keptBytes) const;

  const Object& object_;
  const Capture& truth_;
  ViewPair view_;
  std::vector<Rectangle> steps_;
  std::uint64_t memoryBytes_, tileBytes_;
  Relighter relighter_;
  BytePicture coverage_;
};

}  // namespace illum
