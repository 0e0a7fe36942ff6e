// No fit at all: the samples themselves are the planes (P. Haeberli, "Synthetic Lighting for
// Photography", 1992), and lights between the captured ones are interpolated.
#pragma once

#include <span>

#include "fit/fit.h"

namespace illum {

/// The basis "exact" over basis/light_mesh.h. Of lights from the same direction the first is kept,
/// with a warning. Throws Error (Fault::Usage) for more lights than an object has planes for, and
/// for options that would leave something of the samples out.
Fit fitExact(std::span<const Direction> lights, const SampleStatistics& statistics,
             const FitOptions& options);

}  // namespace illum
