// How much light a surface of microfacets reflects in all, so that what lies below it gets no more
// than the rest.
#pragma once

#include <array>
#include <cstddef>

#include "render/float3.h"

namespace illum {

constexpr std::size_t kAlbedoSteps = 32;  ///< of the cosine, evenly from 0 to 1
/// At the cosines 0, 1/32, ..., 1.
using AlbedoCurve = std::array<float, kAlbedoSteps + 1>;

/// Roughness^2, kept away from a perfect mirror, which no light of a direction alone would show.
float ggxAlpha(float roughness);

/// With Schlick's Fresnel term the directional albedo of GGX is f0 * base + grazing. Both are
/// tabulated over the angle for one roughness.
struct GgxAlbedo {
  AlbedoCurve base, grazing;
};
GgxAlbedo ggxAlbedo(float roughness);

/// Linear between the entries; cosine in [0, 1].
float albedoAt(const AlbedoCurve& curve, float cosine);
/// 2 * integral over cosine * curve: the mean over a uniformly lit hemisphere.
float hemisphericalMean(const AlbedoCurve& curve);

/// A normal drawn from those that are visible from `toViewer` (z up; Heitz 2018, "Sampling the GGX
/// distribution of visible normals"), for two numbers in [0, 1).
Float3 visibleNormal(Float3 toViewer, float alpha, std::array<float, 2> uniform);

}  // namespace illum
