#include <algorithm>
#include <cmath>
#include <numbers>

#include "illum/lighting.h"
#include "light/light_checks.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

float falloffAt(double squaredDistance, Falloff falloff) {
  switch (falloff) {
    case Falloff::InverseSquare:
      return static_cast<float>(1 / squaredDistance);
    case Falloff::Inverse:
      return static_cast<float>(1 / std::sqrt(squaredDistance));
    case Falloff::None:
      break;
  }
  return 1;
}

/// How much of the light goes in a direction whose cosine to the axis is `cosine`.
float patternAt(double cosine, const NearLight& light) {
  switch (light.pattern) {
    case NearLight::Pattern::Everywhere:
      break;
    case NearLight::Pattern::Cosine:
      return static_cast<float>(std::max(0.0, cosine));
    case NearLight::Pattern::Cone: {
      if (cosine <= light.cosOuter) return 0;
      if (cosine >= light.cosInner) return 1;
      const double t = (cosine - light.cosOuter) / (light.cosInner - light.cosOuter);
      return static_cast<float>(t * t * (3 - 2 * t));
    }
  }
  return 1;
}

void add(const DirectionalLight& light, Illumination& out) {
  out.directional.push_back(light);
}

void add(const PointLight& light, Illumination& out) {
  NearLight source;
  source.position = light.position;
  source.intensity = light.intensity;
  source.falloff = light.falloff;
  out.nearby.push_back(source);
}

void add(const SpotLight& light, Illumination& out) {
  NearLight source;
  source.position = light.position;
  source.intensity = light.intensity;
  source.falloff = light.falloff;
  source.pattern = NearLight::Pattern::Cone;
  source.axis = Direction::fromVector(light.target - light.position).vector();
  source.cosInner = std::cos((light.coneDegrees - light.edgeDegrees) * kPi / 180);
  source.cosOuter = std::cos(light.coneDegrees * kPi / 180);
  out.nearby.push_back(source);
}

// Radiance L is pi I / area: a patch dA acts with intensity L dA / pi = I dA / area, times the
// cosine at the light.
void add(const RectangleLight& light, Illumination& out) {
  NearLight source;
  source.intensity = 1.0f / static_cast<float>(light.across * light.down) * light.intensity;
  source.pattern = NearLight::Pattern::Cosine;
  source.axis = Direction::fromVector(cross(light.halfWidth, light.halfHeight)).vector();
  for (int j = 0; j < light.down; ++j) {
    for (int i = 0; i < light.across; ++i) {
      const double x = (2 * i + 1.0) / light.across - 1, y = (2 * j + 1.0) / light.down - 1;
      source.position = light.centre + x * light.halfWidth + y * light.halfHeight;
      out.nearby.push_back(source);
    }
  }
}

// Radiance L is I / r^2: a patch dA acts with intensity L dA / pi = I 4/N when N patches share
// 4 pi r^2, times the cosine at the light. The points are a spherical Fibonacci lattice (R.
// Swinbank, R. J. Purser, "Fibonacci grids", 2006): strata of equal area, evenly spread.
void add(const SphereLight& light, Illumination& out) {
  const double goldenAngle = kPi * (3 - std::sqrt(5.0));
  NearLight source;
  source.intensity = 4.0f / static_cast<float>(light.samples) * light.intensity;
  source.pattern = NearLight::Pattern::Cosine;
  for (int i = 0; i < light.samples; ++i) {
    const double z = 1 - (2 * i + 1.0) / light.samples, across = std::sqrt(1 - z * z);
    const double angle = goldenAngle * i;
    source.axis = {across * std::cos(angle), across * std::sin(angle), z};
    source.position = light.centre + light.radius * source.axis;
    out.nearby.push_back(source);
  }
}

void add(const EnvironmentLight& light, Illumination& out) {
  out.environments.push_back(readEnvironment(light));
}

void add(const SkyLight& light, Illumination& out) {
  out.environments.push_back(skyEnvironment(light));
  if (const auto sun = sunlightOf(light)) out.directional.push_back(*sun);
}

}  // namespace

DirectionalLight NearLight::seenFrom(Vector3 point) const {
  const Vector3 toLight = position - point;
  const double squared = dot(toLight, toLight);
  if (!(squared > kNearest * kNearest)) return {Direction(), {0, 0, 0}};
  const double distance = std::sqrt(squared);
  const float share =
      falloffAt(squared, falloff) * patternAt(-dot(toLight, axis) / distance, *this);
  return {Direction::fromVector(toLight), share * intensity};
}

Illumination illuminationOf(const Lighting& lighting) {
  Illumination illumination;
  for (const Light& light : lighting.lights) {
    checkLight(light);
    std::visit([&](const auto& kind) { add(kind, illumination); }, light);
  }
  return illumination;
}

}  // namespace illum
