// What is decided before the whole capture is read: the lights, the basis, the quantiser.
#pragma once

#include <cstdint>
#include <vector>

#include "build/frames.h"
#include "build/quantiser.h"
#include "fit/fit.h"
#include "illum/build.h"
#include "illum/capture.h"
#include "object/manifest.h"

namespace illum {

/// Which lights are fitted and which are left out (--holdout K: lights K-1, 2K-1, …).
struct LightChoice {
  std::vector<int> used, heldOut;            ///< indices into Capture::lights
  std::vector<DirectionalLight> directions;  ///< of the used
};

/// Throws Error (Fault::Usage) if nothing is left to fit.
LightChoice chooseLights(const Capture& capture, int holdout);

/// How tiles are coded: as asked for, else AVIF, or PNG for the exact basis. Throws Error
/// (Fault::Usage).
Coding codingOf(const BuildOptions& options);

/// The basis of the views that are turned alike, and the operator that is computed once for them.
struct PlannedBasis {
  TurnedFrame frame;
  std::vector<DirectionalLight> directions;  ///< the used lights as the frame sees them
  Fit fit;
};

struct Plan {
  std::vector<PlannedBasis> bases;  ///< at least one
  QuantiserChoice quantiser;        ///< with an entry for each of them

  double leaveOneOutDecibels() const;  ///< the mean over all views
};

/// Reads the pilots and chooses. `memoryBytes` bounds the pilots, of which one is held at a time.
Plan planObject(const Capture& capture, const LightChoice& lights, const BuildOptions& options,
                Response response, std::uint64_t memoryBytes, Progress& progress);

}  // namespace illum
