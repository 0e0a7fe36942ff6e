// Linear light and display-referred values are different types, so that neither is taken for the
// other.
#pragma once

#include <array>
#include <cstdint>

namespace illum {

/// Linear Rec.709, unbounded. 1 is the value of a white surface as photographed under light 1.
struct LinearRgb {
  float r = 0, g = 0, b = 0;
  friend LinearRgb operator+(LinearRgb left, LinearRgb right) {
    return {left.r + right.r, left.g + right.g, left.b + right.b};
  }
  friend LinearRgb operator*(float s, LinearRgb c) { return {s * c.r, s * c.g, s * c.b}; }
  friend bool operator==(const LinearRgb&, const LinearRgb&) = default;
};

/// The sRGB transfer function (IEC 61966-2-1), one channel. Linear light in [0, 1] to encoded
/// values in [0, 1]; extended as an odd function outside, so that it stays invertible.
float displayFromLinear(float linear);

/// The inverse of displayFromLinear.
float linearFromDisplay(float display);

/// What an 8-bit picture stores: clamp to [0, 1], encode, round to nearest. NaN gives 0.
std::uint8_t displayByteFromLinear(float linear);

/// The nearest 8-bit value of an encoded sample in [0, 1]; clamps. NaN gives 0.
std::uint8_t byteFromUnit(float unit);

}  // namespace illum
