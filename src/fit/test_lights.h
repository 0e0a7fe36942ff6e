// Light sets for this module's tests.
#pragma once

#include <random>
#include <vector>

#include "fit/dense.h"

namespace illum::test {

/// Random directions with z >= zLeast; the same for the same seed.
inline std::vector<Direction> randomLights(int count, double zLeast, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> z(zLeast, 1), phi(-3.14, 3.14);
  std::vector<Direction> lights;
  for (int i = 0; i < count; ++i) {
    const double theta = std::acos(z(random));
    lights.push_back(Direction::fromAngles(theta, phi(random)));
  }
  return lights;
}

inline std::vector<DirectionalLight> asLights(const std::vector<Direction>& directions) {
  std::vector<DirectionalLight> lights;
  for (const Direction& d : directions) lights.push_back({d});
  return lights;
}

/// A positive definite lights x lights matrix that looks like second moments.
inline Matrix randomGram(int lights, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Matrix samples(lights, 3 * lights);
  for (double& s : samples.reshaped()) s = uniform(random);
  return samples * samples.transpose() / static_cast<double>(samples.cols());
}

/// Pixels of random normals and colours lit by Lambert's law with a broad highlight: samples as
/// Capture::read gives them, in [0, 1].
inline std::vector<float> shinySamples(const std::vector<Direction>& lights, int pixels,
                                       unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<float> samples(3 * lights.size() * static_cast<std::size_t>(pixels));
  for (int p = 0; p < pixels; ++p) {
    const Vector3 normal =
        Direction::fromAngles(0.6 * uniform(random), 6.28 * uniform(random) - 3.14).vector();
    const double colour[3] = {uniform(random), uniform(random), uniform(random)};
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const double cosine = std::max(0.0, dot(normal, lights[l].vector()));
      for (std::size_t c = 0; c < 3; ++c) {
        samples[(3 * l + c) * pixels + p] =
            static_cast<float>(0.7 * colour[c] * cosine + 0.3 * std::pow(cosine, 8));
      }
    }
  }
  return samples;
}

}  // namespace illum::test
