// Tables of functions that have no smooth continuation past the equator.
#pragma once

#include <functional>
#include <span>

#include "illum/basis_table.h"

namespace illum {

/// As BasisTable::fillChart, but the samples beyond the equator are not f's own: they are those
/// that make interpolation within the disc, near its rim, closest to f in the least-squares sense
/// (by solid angle), with f's continuation as a weak prior. Hemisphere only. Cost grows with the
/// fourth power of N beyond 100: meant for the usual tables.
void fillWithFittedGuard(BasisTable& table,
                         const std::function<void(ChartPoint, std::span<double>)>& f);

}  // namespace illum
