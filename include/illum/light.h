// Light sources. Intensities and radiances: docs/conventions.md, "Radiometry".
#pragma once

#include <filesystem>

#include "illum/colour.h"
#include "illum/vector.h"

namespace illum {

/// Parallel light. Intensity 1 reproduces the photograph that was taken under this direction.
struct DirectionalLight {
  Direction toLight;
  LinearRgb intensity{1, 1, 1};
  friend bool operator==(const DirectionalLight&, const DirectionalLight&) = default;
};

/// How light weakens with the distance d, in units of the object: times 1/d^2, 1/d or 1.
enum class Falloff { InverseSquare, Inverse, None };

/// Shines alike to all sides.
struct PointLight {
  Vector3 position;
  LinearRgb intensity{1, 1, 1};
  Falloff falloff = Falloff::InverseSquare;
  friend bool operator==(const PointLight&, const PointLight&) = default;
};

/// A point light within a cone. Angles are from the axis, which goes from `position` to `target`:
/// full light up to coneDegrees - edgeDegrees, from there less, smoothly, and none from coneDegrees
/// on.
struct SpotLight {
  Vector3 position, target;
  double coneDegrees = 30, edgeDegrees = 6;  ///< 0 <= edge <= cone <= 180, cone > 0
  LinearRgb intensity{1, 1, 1};
  Falloff falloff = Falloff::InverseSquare;
  friend bool operator==(const SpotLight&, const SpotLight&) = default;
};

/// A rectangle of even radiance, shining to the side of halfWidth x halfHeight, which are
/// perpendicular. Far in front of it, it acts as a point light of the same intensity: its radiance
/// is pi * intensity / area. Sampled at across * down points.
struct RectangleLight {
  Vector3 centre, halfWidth{0.5, 0, 0}, halfHeight{0, 0.5, 0};
  LinearRgb intensity{1, 1, 1};
  int across = 4, down = 4;
  friend bool operator==(const RectangleLight&, const RectangleLight&) = default;
};

/// A ball of even radiance. From outside, it acts as a point light of the same intensity, but for
/// the width of its shadows and highlights: its radiance is intensity / radius^2. Sampled at
/// `samples` points, of which each pixel sees about half.
struct SphereLight {
  Vector3 centre;
  double radius = 0.1;
  LinearRgb intensity{1, 1, 1};
  int samples = 64;
  friend bool operator==(const SphereLight&, const SphereLight&) = default;
};

/// An equirectangular picture of radiance all around, infinitely far: y up, its centre -z, u
/// growing toward +x. It is turned by `rotationDegrees` about its own y axis (right-handed: what
/// was at -z goes toward -x), then by the smallest rotation that takes +y to `up`.
struct EnvironmentLight {
  std::filesystem::path picture;
  double rotationDegrees = 0;
  Direction up = Direction::fromVector({0, 1, 0});
  double exposureStops = 0;
  LinearRgb intensity{1, 1, 1};
  friend bool operator==(const EnvironmentLight&, const EnvironmentLight&) = default;
};

enum class SkyModel {
  Overcast,  ///< CIE standard overcast sky, grey
  Clear,     ///< CIE standard clear sky, grey, without the sun itself
  Preetham   ///< daylight after Preetham et al. 1999, in colour
};

/// The sky over a plane whose normal is `up`, and the plane itself below. Intensity 1 gives a white
/// surface that faces `up` the value 1 from the sky alone; the sun is added in its true ratio.
struct SkyLight {
  SkyModel model = SkyModel::Overcast;
  /// Toward the sun; must not lie below the horizon. Overcast skies have none.
  Direction sun = Direction::fromVector({1, 1, 1});
  double turbidity = 3;  ///< Preetham: haze, from 2 (very clear) to 10
  bool sunlight = true;  ///< Preetham: with the sun itself
  double ground = 0.2;   ///< albedo of the ground, in [0, 1]
  Direction up = Direction::fromVector({0, 1, 0});
  LinearRgb intensity{1, 1, 1};
  friend bool operator==(const SkyLight&, const SkyLight&) = default;
};

}  // namespace illum
