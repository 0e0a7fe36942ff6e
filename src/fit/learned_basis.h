// The learned family: principal components over colour and light jointly, their light factors
// kriged.
#pragma once

#include "fit/fit.h"

namespace illum {

/// BasisFamily::Learned of fitBasis. `lights` and `statistics` agree and are not empty.
Fit fitLearned(std::span<const Direction> lights, const SampleStatistics& statistics,
               const FitOptions& options);

}  // namespace illum
