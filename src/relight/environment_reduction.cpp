#include "relight/environment_reduction.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "light/median_cut.h"
#include "relight/tile_planes.h"

namespace illum {
namespace {

constexpr std::size_t kPart = 64;  // lights that are added up by themselves, then in order

/// The probe's linear RGB under lights, each decoded, linearised, added.
std::vector<double> relitProbe(std::span<const DirectionalLight> lights, const LightBasis& basis,
                               const CodingEntry& coding, Response response,
                               const PlaneCodes& probe) {
  const TilePlanes planes(probe, coding.bits);
  const std::size_t samples = 3 * probe.tile.pixels();
  const std::size_t parts = (lights.size() + kPart - 1) / kPart;
  std::vector<std::vector<double>> sums(parts);
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    std::vector<float> rgb(samples);
    sums[part].assign(samples, 0);
    const std::size_t end = std::min((part + 1) * kPart, lights.size());
    for (std::size_t n = part * kPart; n < end; ++n) {
      weightedSum(planes, coding, foldWeights(basis, coding, lights[n].toLight), 0, rgb);
      applyResponse(response, rgb);
      const LinearRgb& intensity = lights[n].intensity;
      for (std::size_t i = 0; i < samples; i += 3) {
        sums[part][i] += intensity.r * rgb[i];
        sums[part][i + 1] += intensity.g * rgb[i + 1];
        sums[part][i + 2] += intensity.b * rgb[i + 2];
      }
    }
  });
  std::vector<double> picture(samples);
  for (const auto& part : sums) {
    for (std::size_t i = 0; i < samples; ++i) picture[i] += part[i];
  }
  return picture;
}

double relativeError(const std::vector<double>& picture, const std::vector<double>& reference) {
  double squares = 0, all = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    squares += (picture[i] - reference[i]) * (picture[i] - reference[i]);
    all += reference[i] * reference[i];
  }
  return all > 0 ? std::sqrt(squares / all) : 0;
}

}  // namespace

PlaneCodes probeOf(const PlaneCodes& tile, std::size_t texels) {
  const std::size_t step = std::max<std::size_t>(1, tile.tile.pixels() / texels) | 1;
  const std::size_t count = (tile.tile.pixels() + step - 1) / step;
  PlaneCodes probe{tile.planes, {static_cast<int>(count), 1}, {}};
  for (int k = 0; k < tile.planes; ++k) {
    for (std::size_t i = 0; i < tile.tile.pixels(); i += step)
      probe.values.push_back(tile.plane(k)[i]);
  }
  return probe;
}

// The error falls with the number of directions, though not at every step; so the search doubles
// and then halves.
ReducedEnvironment reduceEnvironment(const Environment& environment, const LightBasis& basis,
                                     const CodingEntry& coding, Response response,
                                     const PlaneCodes& probe, double bound) {
  const MedianCut cut(environment, kReferenceRegions);
  const auto picture = [&](const std::vector<DirectionalLight>& lights) {
    return relitProbe(lights, basis, coding, response, probe);
  };
  const std::vector<double> reference = picture(cut.lights(kReferenceRegions));
  const auto reduced = [&](int regions) {
    ReducedEnvironment result{cut.lights(regions), 0};
    result.error = relativeError(picture(result.lights), reference);
    return result;
  };
  const int most = std::min(kMostDirections, std::max(1, cut.mostLights()));
  int enough = 1, tooFew = 0;
  ReducedEnvironment best = reduced(enough);
  while (best.error > bound && enough < most) {
    tooFew = enough;
    enough = std::min(2 * enough, most);
    best = reduced(enough);
  }
  while (best.error <= bound && enough - tooFew > std::max(1, enough / 16)) {
    const int middle = (tooFew + enough) / 2;
    ReducedEnvironment tried = reduced(middle);
    if (tried.error <= bound) {
      enough = middle;
      best = std::move(tried);
    } else {
      tooFew = middle;
    }
  }
  return best;
}

}  // namespace illum
