// The families of closed form (SH, HSH, DCT), fitted channel by channel.
#pragma once

#include <span>

#include "fit/fit.h"

namespace illum {

/// fitBasis for every family but Learned. `lights` and `statistics` agree and are not empty.
Fit fitSeparable(std::span<const Direction> lights, const SampleStatistics& statistics,
                 const FitOptions& options);

}  // namespace illum
