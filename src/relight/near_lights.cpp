#include "relight/near_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace illum {

NearLights::NearLights(const LightBasis& basis, const CodingEntry& coding, Response response,
                       std::vector<NearLight> lights)
    : basis_(&basis), coding_(coding), response_(response), lights_(std::move(lights)) {}

// The value of each basis function's plane, and 1 for the mean.
void NearLights::planeValues(const TilePlanes& codes, std::size_t texel,
                             std::span<float> values) const {
  std::fill(values.begin(), values.end(), 0.0f);
  for (std::size_t p = 0; p < coding_.functions.size(); ++p) {
    const double value = valueOfCode(coding_, p, codes.code(p, texel));
    values[static_cast<std::size_t>(coding_.functions[p])] += static_cast<float>(value);
  }
  values.back() = 1;
}

void NearLights::addTo(std::span<float> rgb, const TilePlanes& codes, std::size_t first,
                       std::span<const Vector3> points, std::vector<float>& scratch) const {
  const std::size_t size = basis_->evaluateSize();
  scratch.resize(size + size / 3);
  const std::span<float> basis(scratch.data(), size), values(scratch.data() + size, size / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    planeValues(codes, first + i, values);
    for (const NearLight& light : lights_) {
      const DirectionalLight seen = light.seenFrom(points[i]);
      if (seen.intensity == LinearRgb{0, 0, 0}) continue;
      basis_->evaluate(seen.toLight, basis);
      std::array<float, 3> colour{};
      for (std::size_t k = 0; k < values.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) colour[c] += values[k] * basis[3 * k + c];
      }
      applyResponse(response_, colour);
      rgb[3 * i] += seen.intensity.r * colour[0];
      rgb[3 * i + 1] += seen.intensity.g * colour[1];
      rgb[3 * i + 2] += seen.intensity.b * colour[2];
    }
  }
}

}  // namespace illum
