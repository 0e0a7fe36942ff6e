// Textures, filtered.
#pragma once

#include <array>
#include <vector>

#include "scene/scene.h"

namespace illum {

/// A displacement or position in texture coordinates, v up.
struct TexturePoint {
  float u = 0, v = 0;
};

/// The part of a texture that a beam covers: half axes of an ellipse.
struct TextureFootprint {
  TexturePoint major, minor;
};

using Texel = std::array<float, 4>;  ///< red, green, blue, alpha (1 where the texture has none)

/// A texture at all its scales. Thread safe.
class TexturePyramid {
 public:
  /// Precondition: not empty, 1, 3 or 4 channels.
  explicit TexturePyramid(const Texture& texture);

  /// The mean over a footprint: points along its longer axis, each from the two levels about the
  /// shorter one (Feline: McCormack, Perry, Farkas, Jouppi 1999).
  Texel mean(TexturePoint at, const TextureFootprint& footprint) const;

  /// Between the four texels about a point of the finest level.
  Texel bilinear(TexturePoint at) const { return bilinear(0, at); }

  std::uint64_t bytes() const;

 private:
  Texel bilinear(std::size_t level, TexturePoint at) const;
  Texel trilinear(float level, TexturePoint at) const;

  std::vector<Picture> levels_;
};

}  // namespace illum
