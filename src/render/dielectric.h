// Ideal reflection and refraction.
#pragma once

#include <cmath>
#include <optional>

#include "render/float3.h"

namespace illum {

/// Of light from vacuum onto a smooth dielectric, both polarisations (Fresnel 1823). `ior` >= 1.
inline float dielectricReflectance(float cosine, float ior) {
  cosine = std::max(cosine, 1e-6f);
  const float inside = std::sqrt(std::max(0.0f, 1 - (1 - cosine * cosine) / (ior * ior)));
  const float across = (cosine - ior * inside) / (cosine + ior * inside);
  const float along = (ior * cosine - inside) / (ior * cosine + inside);
  return 0.5f * (across * across + along * along);
}

/// `toViewer` mirrored about a unit normal.
inline Float3 mirrored(Float3 toViewer, Float3 normal) {
  return 2 * dot(toViewer, normal) * normal - toViewer;
}

/// Where a ray goes that arrives against `toViewer`, on the side of `normal`, and passes a surface
/// with refractive index n_on_the_other_side / n_here; empty: total reflection.
inline std::optional<Float3> refracted(Float3 toViewer, Float3 normal, float relativeIor) {
  const float cosine = dot(toViewer, normal);
  const float squared = 1 - (1 - cosine * cosine) / (relativeIor * relativeIor);
  if (squared < 0) return std::nullopt;
  return normalised((cosine / relativeIor - std::sqrt(squared)) * normal -
                    (1 / relativeIor) * toViewer);
}

}  // namespace illum
