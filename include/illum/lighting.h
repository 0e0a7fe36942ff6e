// Any number of lights of any kinds, as a small file of JSON (docs/guide/lighting.md) and as what
// relighting works with.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "illum/environment.h"
#include "illum/light.h"

namespace illum {

using Light = std::variant<DirectionalLight, PointLight, SpotLight, RectangleLight, SphereLight,
                           EnvironmentLight, SkyLight>;

struct Lighting {
  std::vector<Light> lights;
  friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// Parses a set-up; touches no file: names of pictures stay as they are written. Fields that are
/// not known are refused. Untrusted input is safe. Throws Error naming `source` and the field.
Lighting lightingFromText(std::string_view json, const std::string& source);
/// Deterministic; lightingFromText gives the same set-up again. Throws Error (Fault::Input) for
/// what lightingFromText would refuse.
std::string textOf(const Lighting& lighting);

/// Reads a file; names of pictures are taken relative to its folder. Throws Error.
Lighting readLighting(const std::filesystem::path& file);
/// Replaces `file` atomically. Names of pictures are written as they are.
void writeLighting(const std::filesystem::path& file, const Lighting& lighting);

/// Light from a place near the object: what point and spot lights, and the samples of area lights,
/// come down to.
struct NearLight {
  enum class Pattern { Everywhere, Cone, Cosine };

  Vector3 position;
  LinearRgb intensity{1, 1, 1};
  Falloff falloff = Falloff::InverseSquare;
  Pattern pattern = Pattern::Everywhere;
  Vector3 axis{0, 0, -1};  ///< unit vector out of the light: of the cone, or the surface
  double cosInner = -1, cosOuter = -1;  ///< of a cone: full light inside, none outside

  /// As it acts on a point of the object frame: a directional light, without falloff and pattern in
  /// its direction but in its intensity. Nearer than kNearest it gives none, in any direction.
  DirectionalLight seenFrom(Vector3 point) const;
  static constexpr double kNearest = 1e-6;
};

/// Lights as relighting works with them.
struct Illumination {
  std::vector<DirectionalLight> directional;
  std::vector<NearLight> nearby;
  std::vector<Environment> environments;
};

/// Reads pictures, computes skies, puts sample points on area lights. Throws Error, also for lights
/// that textOf would refuse.
Illumination illuminationOf(const Lighting& lighting);

}  // namespace illum
