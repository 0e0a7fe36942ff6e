#include "render/surface_bsdf.h"

#include <numbers>

#include "render/dielectric.h"
#include "render/surface_kernel.h"

namespace illum {
namespace {

// Roughness below which highlights are looked for with drawn directions too.
constexpr float kGlossyAlpha = 0.3f;

float luminance(LinearRgb c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

}  // namespace

SurfaceBsdf::SurfaceBsdf(const SurfacePoint& point, Float3 toViewer)
    : alpha_(ggxAlpha(point.roughness)) {
  const GgxAlbedo albedo = ggxAlbedo(point.roughness);
  const float dielectric = 0.08f * point.specular;
  // No real dielectric reflects less than 2 % head on: below that the highlight fades out as a
  // whole, so that `specular` 0 is a matt surface (Lagarde and de Rousiers 2014, section 3.1.1).
  const float dielectricGrazing = std::min(1.0f, 50 * dielectric);
  lobes_.geometricNormal = point.geometricNormal;
  lobes_.normal = point.shadingNormal;
  lobes_.toViewer = toViewer;
  lobes_.viewerCosine = std::clamp(dot(point.shadingNormal, toViewer), 1e-4f, 1.0f);
  lobes_.alphaSquared = alpha_ * alpha_;
  lobes_.viewerShadowing = std::sqrt(
      lobes_.alphaSquared + (1 - lobes_.alphaSquared) * lobes_.viewerCosine * lobes_.viewerCosine);
  // Schlick's term is linear in its colour: a mixture of both materials is one evaluation.
  const float bare = 1 - point.metallic;
  const auto facing = [&](float colour) { return bare * dielectric + point.metallic * colour; };
  lobes_.facing = {facing(point.colour.r), facing(point.colour.g), facing(point.colour.b)};

  lobes_.grazing = bare * dielectricGrazing + point.metallic;

  for (std::size_t k = 0; k <= kAlbedoSteps; ++k) {
    lobes_.passes[k] = 1 - (dielectric * albedo.base[k] + dielectricGrazing * albedo.grazing[k]);
  }
  const float inward = albedoAt(lobes_.passes, lobes_.viewerCosine);
  lobes_.matt = (bare * inward / (std::numbers::pi_v<float> * hemisphericalMean(lobes_.passes))) *
                point.colour;

  const float glossy = luminance(lobes_.facing) * albedoAt(albedo.base, lobes_.viewerCosine) +
                       lobes_.grazing * albedoAt(albedo.grazing, lobes_.viewerCosine);
  const float matt = bare * inward * luminance(point.colour);
  // Neither kind of sample is left out where it can contribute.
  lobes_.glossyShare = glossy > 0 ? std::max(0.1f, glossy / (glossy + matt)) : 0;
  if (matt > 0) lobes_.glossyShare = std::min(0.9f, lobes_.glossyShare);
}

void SurfaceBsdf::evaluate(const DirectionBatch& toLight, std::size_t count, BsdfBatch& out) const {
  evaluateLobes(lobes_, toLight, count, out);
}

std::optional<BsdfSample> SurfaceBsdf::sample(float choice, std::array<float, 2> uniform) const {
  const Frame frame(lobes_.normal);
  Float3 direction;
  if (choice < lobes_.glossyShare) {
    const Float3 toViewer = frame.local(lobes_.toViewer);
    direction = frame.world(mirrored(toViewer, visibleNormal(toViewer, alpha_, uniform)));
  } else {
    const float radius = std::sqrt(uniform[0]);
    const float angle = 2 * std::numbers::pi_v<float> * uniform[1];
    direction = frame.world({radius * std::cos(angle), radius * std::sin(angle),
                             std::sqrt(std::max(0.0f, 1 - uniform[0]))});
  }
  DirectionBatch batch;
  batch.x.fill(direction.x);
  batch.y.fill(direction.y);
  batch.z.fill(direction.z);
  BsdfBatch value;
  evaluate(batch, 1, value);
  const float density = value.density[0];
  if (!(density > 0)) return std::nullopt;
  const float inverse = 1 / density;
  return BsdfSample{
      direction, {value.r[0] * inverse, value.g[0] * inverse, value.b[0] * inverse}, density};
}

bool SurfaceBsdf::isGlossy() const {
  return alpha_ < kGlossyAlpha && lobes_.glossyShare > 0;
}

}  // namespace illum
