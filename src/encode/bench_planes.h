// Planes to measure codings with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "codec/tile.h"

namespace illum {

/// Codes of 8 bits at one common step, and what they stand for.
struct BenchPlanes {
  std::string name;
  PlaneCodes codes;
  std::vector<float> values;   ///< before quantising, laid out as codes.values
  std::vector<float> offsets;  ///< value = offsets[plane] + step * code
  double step = 1;

  /// Decibels, peak 1, of a photograph's sample relit from `decoded` against the same relit from
  /// `values`: the planes are orthonormal over the photographs.
  double decibels(const PlaneCodes& decoded) const;
};

/// The principal planes, over colour and light jointly, of the JPEG photographs in `folder`, which
/// are small and of one size. Throws Error.
BenchPlanes photographPlanes(const std::filesystem::path& folder, int planes);

/// A bumpy surface of smooth albedo with a little noise, in the first spherical harmonics.
BenchPlanes syntheticPlanes(Size size, int planes);

}  // namespace illum
