// The description of every kind of light (json/field.h; docs/guide/lighting.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "illum/lighting.h"
#include "json/field.h"

namespace illum::fields {

inline constexpr int kLightingVersion = 1;
inline constexpr std::size_t kMaxLightsOfSetup = 10'000;
inline constexpr int kMaxSamplesAcross = 64;  // of an area light
inline constexpr int kMaxSphereSamples = 4096;

/// In the order of Light's alternatives.
enum class LightKind { Directional, Point, Spot, Rectangle, Sphere, Environment, Sky };

template <typename Visitor>
void direction(Visitor& v, Name name, Direction& d) {
  Vector3 vector = d.vector();
  v.triple(name, coordinatesOf(vector), -kHuge, kHuge);
  d = Direction::fromVector(vector);
}

/// A product in memory; in the file apart, the colour's largest channel being 1. Products of
/// doubles rounded to float give the same floats again.
template <typename Visitor>
void intensity(Visitor& v, LinearRgb& rgb) {
  double scale = std::max({std::abs(rgb.r), std::abs(rgb.g), std::abs(rgb.b)});
  std::array<double, 3> colour{1, 1, 1};
  if (scale > 0) colour = {rgb.r / scale, rgb.g / scale, rgb.b / scale};
  v.number(optional("intensity"), scale, 0, kHuge);
  v.numbers(optional("colour"), colour, -1, 1);
  rgb = {static_cast<float>(scale * colour[0]), static_cast<float>(scale * colour[1]),
         static_cast<float>(scale * colour[2])};
}

template <typename Visitor>
void falloff(Visitor& v, Falloff& value) {
  v.choice(optional("falloff"), value,
           Choices<Falloff>{{Falloff::InverseSquare, "inverseSquare"},
                            {Falloff::Inverse, "inverse"},
                            {Falloff::None, "none"}});
}

template <typename Visitor>
void point(Visitor& v, Name name, Vector3& value) {
  v.triple(name, coordinatesOf(value), -kHuge, kHuge);
}

template <typename Visitor>
void describe(Visitor& v, DirectionalLight& light) {
  direction(v, "direction", light.toLight);
  intensity(v, light.intensity);
}

template <typename Visitor>
void describe(Visitor& v, PointLight& light) {
  point(v, "position", light.position);
  intensity(v, light.intensity);
  falloff(v, light.falloff);
}

template <typename Visitor>
void describe(Visitor& v, SpotLight& light) {
  point(v, "position", light.position);
  point(v, "target", light.target);
  v.number(optional("coneDegrees"), light.coneDegrees, 1e-3, 180);
  v.number(optional("edgeDegrees"), light.edgeDegrees, 0, 180);
  intensity(v, light.intensity);
  falloff(v, light.falloff);
}

template <typename Visitor>
void describe(Visitor& v, RectangleLight& light) {
  point(v, "centre", light.centre);
  point(v, optional("halfWidth"), light.halfWidth);
  point(v, optional("halfHeight"), light.halfHeight);
  intensity(v, light.intensity);
  v.integer(optional("across"), light.across, 1, kMaxSamplesAcross);
  v.integer(optional("down"), light.down, 1, kMaxSamplesAcross);
}

template <typename Visitor>
void describe(Visitor& v, SphereLight& light) {
  point(v, "centre", light.centre);
  v.number("radius", light.radius, 1e-6, kHuge);
  intensity(v, light.intensity);
  v.integer(optional("samples"), light.samples, 2, kMaxSphereSamples);
}

template <typename Visitor>
void describe(Visitor& v, EnvironmentLight& light) {
  std::string picture = light.picture.string();
  v.text("picture", picture);
  light.picture = picture;
  v.number(optional("rotationDegrees"), light.rotationDegrees, -360, 360);
  direction(v, optional("up"), light.up);
  v.number(optional("exposureStops"), light.exposureStops, -64, 64);
  intensity(v, light.intensity);
}

template <typename Visitor>
void describe(Visitor& v, SkyLight& light) {
  v.choice("model", light.model,
           Choices<SkyModel>{{SkyModel::Overcast, "overcast"},
                             {SkyModel::Clear, "clear"},
                             {SkyModel::Preetham, "preetham"}});
  direction(v, optional("sun"), light.sun);
  v.number(optional("turbidity"), light.turbidity, 2, 10);
  v.flag(optional("sunlight"), light.sunlight);
  v.number(optional("ground"), light.ground, 0, 1);
  direction(v, optional("up"), light.up);
  intensity(v, light.intensity);
}

/// A light of that kind with its defaults.
inline Light lightOf(LightKind kind) {
  switch (kind) {
    case LightKind::Directional:
      return DirectionalLight();
    case LightKind::Point:
      return PointLight();
    case LightKind::Spot:
      return SpotLight();
    case LightKind::Rectangle:
      return RectangleLight();
    case LightKind::Sphere:
      return SphereLight();
    case LightKind::Environment:
      return EnvironmentLight();
    case LightKind::Sky:
      break;
  }
  return SkyLight();
}

template <typename Visitor>
void describe(Visitor& v, Light& light) {
  auto kind = static_cast<LightKind>(light.index());
  v.choice("kind", kind,
           Choices<LightKind>{{LightKind::Directional, "directional"},
                              {LightKind::Point, "point"},
                              {LightKind::Spot, "spot"},
                              {LightKind::Rectangle, "rectangle"},
                              {LightKind::Sphere, "sphere"},
                              {LightKind::Environment, "environment"},
                              {LightKind::Sky, "sky"}});
  if (static_cast<std::size_t>(kind) != light.index()) light = lightOf(kind);
  std::visit([&](auto& one) { describe(v, one); }, light);
}

/// The file.
struct LightingRecord {
  int version = kLightingVersion;
  std::vector<Light> lights;
};

template <typename Visitor>
void describe(Visitor& v, LightingRecord& file) {
  v.integer("lighting", file.version, kLightingVersion, kLightingVersion);
  v.records("lights", file.lights, 1, kMaxLightsOfSetup);
}

}  // namespace illum::fields
