// What is decided before the whole capture is read: the lights, the basis, the quantiser.
#pragma once

#include <cstdint>
#include <vector>

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

struct Plan {
  Fit fit;
  QuantiserChoice quantiser;
};

/// Reads the pilot and chooses. `memoryBytes` bounds the pilot.
Plan planObject(const Capture& capture, const LightChoice& lights, const BuildOptions& options,
                Response response, std::uint64_t memoryBytes, Progress& progress);

}  // namespace illum
