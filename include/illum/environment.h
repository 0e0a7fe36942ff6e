// Light from all around, infinitely far away: pictures of radiance, and skies by formula.
#pragma once

#include <functional>
#include <optional>

#include "illum/light.h"
#include "illum/picture.h"
#include "illum/transform.h"

namespace illum {

/// An equirectangular map of radiance (docs/conventions.md, "Radiometry"), turned and scaled. Its
/// texels act as directional lights of intensity radiance * solid angle / pi.
class Environment {
 public:
  /// `radiance`: twice as wide as high; its first channel if it has one, else its first three.
  /// Throws Error (Fault::Input) for another shape and for values that are not finite.
  explicit Environment(Picture radiance, const RigidTransform& objectFromMap = {},
                       LinearRgb scale = {1, 1, 1});

  const Picture& radiance() const { return radiance_; }
  Size size() const { return radiance_.size(); }
  const RigidTransform& objectFromMap() const { return objectFromMap_; }

  /// The texel as a light of the object frame.
  DirectionalLight texel(int column, int row) const;
  /// The radiance, scaled, that comes from there: of the nearest texel.
  LinearRgb radianceFrom(Direction d) const;
  /// The same map turned further: every light's direction w becomes rotation * w.
  Environment turned(const RigidTransform& rotation) const;

 private:
  LinearRgb scaled(int column, int row) const;

  Picture radiance_;
  RigidTransform objectFromMap_;
  LinearRgb scale_;
};

/// Equirectangular maps: u to the right, v down, both in [0, 1]; y up, centre -z, u toward +x.
Direction directionFromMap(double u, double v);
/// Of one texel in the given row of a map, in steradians.
double texelSolidAngle(int row, Size map);

/// How an environment light's picture is turned: about its own y, then +y to `up`.
RigidTransform objectFromMap(double rotationDegrees, Direction up);

/// Reads the light's picture. Untrusted input is safe. Throws Error naming the file.
Environment readEnvironment(const EnvironmentLight& light);

/// The sky's radiance from a direction of the object frame, without the sun itself. Throws Error
/// (Fault::Input) for a sun below the horizon and numbers out of range.
std::function<LinearRgb(Direction)> skyRadiance(const SkyLight& sky);
/// The same as a map.
Environment skyEnvironment(const SkyLight& sky, Size size = {512, 256});
/// The sun itself, where the sky has one.
std::optional<DirectionalLight> sunlightOf(const SkyLight& sky);

}  // namespace illum
