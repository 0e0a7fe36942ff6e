// An object beside the photographs that it is judged by, both in the same form.
#pragma once

#include <cstdint>
#include <functional>

#include "illum/capture.h"
#include "illum/object.h"
#include "illum/relight.h"
#include "study/photograph.h"

namespace illum {

/// Gives relit pictures and photographs as linear RGB over black. If the object has a mask, both
/// are multiplied by coverage: the relit picture by the object's, the photograph by the capture's
/// (by the object's, if the capture has none). Thread safe.
class Comparison {
 public:
  /// Keeps references. `tileMemoryBytes` bounds the object's decoded tiles. Throws Error
  /// (Fault::Input) if the sizes differ or there is no light.
  Comparison(const Object& object, const Capture& truth, std::uint64_t tileMemoryBytes);

  const Capture& truth() const { return truth_; }
  /// 1 channel; empty if neither side has a mask.
  const BytePicture& coverage() const { return coverage_; }

  /// Under the light of photograph `light` (an index) with its intensity.
  Picture relit(int light) const;
  void readPhotograph(int light, const std::function<void(const PhotographBand&)>& use) const;

 private:
  const Object& object_;
  const Capture& truth_;
  Relighter relighter_;
  BytePicture coverage_;
};

}  // namespace illum
