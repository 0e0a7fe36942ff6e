#include "relight/passes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "basis/light_sum.h"

namespace illum {
namespace {

// Parts of a map that are added up by themselves, then in order: the same sum on any number of
// threads.
constexpr int kBands = 16;

}  // namespace

void addEnvironment(LightSum& sum, const Environment& environment) {
  const Size size = environment.size();
  std::vector<LightSum> parts(kBands, sum.emptyCopy());
  tbb::parallel_for(0, kBands, [&](int band) {
    const auto edge = [&](int b) {
      return static_cast<int>(std::int64_t{b} * size.height / kBands);
    };
    for (int row = edge(band); row < edge(band + 1); ++row) {
      for (int column = 0; column < size.width; ++column) {
        const DirectionalLight light = environment.texel(column, row);
        if (light.intensity == LinearRgb()) continue;
        parts[static_cast<std::size_t>(band)].add(light.toLight, light.intensity);
      }
    }
  });
  for (const LightSum& part : parts) sum.add(part);
}

Passes::Passes(const LightBasis& basis, const CodingEntry& coding, Response response,
               std::span<const DirectionalLight> lights, std::span<const Environment> environments)
    : coding_(coding), response_(response) {
  if (response == Response::Linear) {
    LightSum sum(basis);
    for (const DirectionalLight& light : lights) sum.add(light.toLight, light.intensity);
    for (const Environment& environment : environments) addEnvironment(sum, environment);
    passes_.push_back({foldWeights(sum.weights(basis), coding), {}});
    return;
  }
  assert(environments.empty());
  for (const DirectionalLight& light : lights)
    passes_.push_back({foldWeights(basis, coding, light.toLight), light.intensity});
}

void Passes::relight(const TilePlanes& codes, std::size_t first, std::span<float> rgb,
                     std::vector<float>& scratch) const {
  if (response_ == Response::Linear && !passes_.empty()) {
    weightedSum(codes, coding_, passes_.front().weights, first, rgb);
    return;
  }
  std::fill(rgb.begin(), rgb.end(), 0.0f);
  scratch.resize(rgb.size());
  for (const Pass& pass : passes_) {
    weightedSum(codes, coding_, pass.weights, first, scratch);
    applyResponse(response_, scratch);
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
      rgb[i] += pass.intensity.r * scratch[i];
      rgb[i + 1] += pass.intensity.g * scratch[i + 1];
      rgb[i + 2] += pass.intensity.b * scratch[i + 2];
    }
  }
}

}  // namespace illum
