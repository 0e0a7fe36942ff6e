#include "render/hair_bsdf.h"

#include <cmath>
#include <numbers>

namespace illum {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
// Share of the matt light that goes on through the fibre.
constexpr float kForward = 0.3f;

// How a matt cylinder spreads light in azimuth; the integral over the circle is 1.
float mattCylinder(float cosine, float sine, float angle) {
  return ((kPi - angle) * cosine + sine) * 0.125f;
}
float spreadInAzimuth(float cosine) {
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  const float angle = std::acos(std::clamp(cosine, -1.0f, 1.0f));
  return (1 - kForward) * mattCylinder(cosine, sine, angle) +
         kForward * mattCylinder(-cosine, sine, kPi - angle);
}

// 1 / integral of exp(k (cos x - 1)) over a turn, which is 2 pi I0(k) exp(-k); by the asymptotic
// series of I0 (Abramowitz and Stegun 9.7.1), good to 0.0005 from k = 4 on.
float vonMisesHeight(float k) {
  const float series = 1 + (1 / (8 * k)) * (1 + (9 / (16 * k)) * (1 + 25 / (24 * k)));
  return std::sqrt(k / (2 * kPi)) / series;
}

}  // namespace

HairBsdf::HairBsdf(const SurfacePoint& point, Float3 toViewer)
    : tangent_(point.tangent), toViewer_(toViewer) {
  viewerAlong_ = dot(tangent_, toViewer);
  viewerAcross_ = std::sqrt(std::max(1e-6f, 1 - viewerAlong_ * viewerAlong_));
  gloss_ = 0.08f * point.specular;
  matt_ = ((1 - gloss_) * 2 / kPi) * point.colour;
  // A lobe of standard deviation roughness^2 / 2 and at least 3 degrees.
  const float width = std::max(0.05f, 0.5f * point.roughness * point.roughness);
  concentration_ = 1 / (width * width);
  lobe_ = vonMisesHeight(concentration_);
}

void HairBsdf::evaluate(const DirectionBatch& toLight, std::size_t count, BsdfBatch& out) const {
  for (std::size_t i = 0; i < count; ++i) {
    const Float3 light{toLight.x[i], toLight.y[i], toLight.z[i]};
    const float along = dot(tangent_, light);
    const float across = std::sqrt(std::max(0.0f, 1 - along * along));
    const float cosine = std::clamp(
        (dot(light, toViewer_) - along * viewerAlong_) / std::max(1e-6f, across * viewerAcross_),
        -1.0f, 1.0f);
    const float matt = spreadInAzimuth(cosine);
    // cos(theta_light + theta_viewer), angles from the plane across the fibre.
    const float offCone = across * viewerAcross_ - along * viewerAlong_;
    const float glossy = gloss_ * lobe_ * std::exp(concentration_ * (offCone - 1)) * 0.25f *
                         std::sqrt(0.5f * (1 + cosine));
    out.r[i] = across * (matt_.r * matt + glossy);
    out.g[i] = across * (matt_.g * matt + glossy);
    out.b[i] = across * (matt_.b * matt + glossy);
    // Directions are drawn proportional to `across`, even in azimuth.
    out.density[i] = across / (kPi * kPi);
  }
}

std::optional<BsdfSample> HairBsdf::sample(float choice, std::array<float, 2> uniform) const {
  // A coordinate of a point that is even in the disc has the density sqrt(1 - x^2).
  const float along = std::sqrt(uniform[0]) * std::cos(2 * kPi * uniform[1]);
  const float across = std::sqrt(std::max(0.0f, 1 - along * along));
  const Frame frame(tangent_);
  const float azimuth = 2 * kPi * choice;
  const Float3 direction =
      frame.world({across * std::cos(azimuth), across * std::sin(azimuth), along});
  DirectionBatch batch;
  batch.x[0] = direction.x;
  batch.y[0] = direction.y;
  batch.z[0] = direction.z;
  BsdfBatch value;
  evaluate(batch, 1, value);
  if (!(value.density[0] > 0)) return std::nullopt;
  const float inverse = 1 / value.density[0];
  return BsdfSample{direction,
                    {value.r[0] * inverse, value.g[0] * inverse, value.b[0] * inverse},
                    value.density[0]};
}

}  // namespace illum
