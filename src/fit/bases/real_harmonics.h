// The paper's real spherical harmonics as polynomials (Wong et al. 1997, section 4.1).
#pragma once

#include <span>

namespace illum {

/// Largest degree that is offered: 81 functions.
inline constexpr int kMaxHarmonicDegree = 8;

/// values[l (l + 1) + m] = Y_lm for l = 0 … lMax, m = -l … l at the point with cos(theta) = `z` and
/// sin(theta) (cos(phi), sin(phi)) = (`x`, `y`). Normalisation and signs are the paper's: N_lm, the
/// factor (1 - 2m) of its recurrence, so that Y_1,1 is negative toward +x; cosines for m > 0.
void realHarmonics(double x, double y, double z, int lMax, std::span<double> values);

}  // namespace illum
