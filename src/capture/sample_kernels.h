// Kernels of sample_rows.cpp, for the instruction set of the machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace illum {

/// Interleaved samples (1, 3 or 4 channels; the fourth is left out; grey goes to all three) to
/// three rows of floats, divided by the type's white. The quotient is the correctly rounded one, so
/// a byte is exactly byte / 255.0f on every machine.
void planarFromBytes(const std::uint8_t* samples, int channels, std::size_t count, float* r,
                     float* g, float* b);
void planarFromWords(const std::uint16_t* samples, int channels, std::size_t count, float* r,
                     float* g, float* b);
void planarFromFloats(const float* samples, int channels, std::size_t count, float* r, float* g,
                      float* b);

/// The same into three rows of bytes, as they are.
void separateBytes(const std::uint8_t* samples, int channels, std::size_t count, std::uint8_t* r,
                   std::uint8_t* g, std::uint8_t* b);

/// Whether all are finite.
bool allFinite(const float* samples, std::size_t count);

}  // namespace illum
