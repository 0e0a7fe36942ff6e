// What light_basis_family.cpp chooses from: one function a family, each in its own file.
#pragma once

#include <memory>

#include "fit/bases/light_basis_family.h"

namespace illum {

/// Spherical harmonics of degree 0 … lMax.
std::unique_ptr<AnalyticBasis> sphericalHarmonics(int lMax, LightDomain domain);
/// Hemispherical harmonics of degree 0 … lMax.
std::unique_ptr<AnalyticBasis> hemisphericalHarmonics(int lMax);
/// Cosines on the stereographic square, or on both.
std::unique_ptr<AnalyticBasis> chartCosines(int coefficients, LightDomain domain);

}  // namespace illum
