// From planes to codes at one common step (DESIGN §5, docs/math/quantising.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/tile.h"
#include "fit/fit.h"
#include "object/manifest.h"

namespace illum {

struct QuantiserRequest {
  Coding coding = Coding::Avif;
  std::optional<int> bits;     ///< unset: chosen
  std::optional<Curve> curve;  ///< unset: chosen
  double targetDecibels = 50;  ///< PSNR on screen of quantisation alone, that is chosen for
};

struct QuantiserChoice {
  CodingEntry entry;
  double decibels = 0;  ///< reached on the pilot
};

/// Chooses bits, curve, step and offsets. `planes`: (basis planes) x `pixels` values of the pilot;
/// `complete`: these are all the values there will be, so that the ranges need no margin.
QuantiserChoice chooseQuantiser(const Fit& fit, std::span<const DirectionalLight> lights,
                                Response response, std::span<const float> planes,
                                std::size_t pixels, bool complete, const QuantiserRequest& request);

/// Quantises plane values of one tile: `planes` is (basis planes) x tile.pixels(). Values outside
/// the quantiser's range take its nearest end and are counted in `clipped`.
PlaneCodes quantise(const CodingEntry& entry, std::span<const float> planes, Size tile,
                    std::uint64_t& clipped);

/// The inverse: values of the basis planes (sums of stored planes). For tests and simulation.
std::vector<float> dequantise(const CodingEntry& entry, const PlaneCodes& codes, int basisPlanes);

}  // namespace illum
