#include "build/poster.h"

#include <algorithm>
#include <vector>

#include "relight/weighted_sum.h"

namespace illum {
namespace {

Direction posterLight(std::span<const DirectionalLight> lights) {
  const Direction wanted = Direction::fromVector({-0.4, 0.5, 0.8});
  return std::min_element(lights.begin(), lights.end(),
                          [&](const auto& a, const auto& b) {
                            return angleRadians(a.toLight, wanted) <
                                   angleRadians(b.toLight, wanted);
                          })
      ->toLight;
}

// The means of factor x factor blocks; what does not fill a block is left out.
Picture scaledDown(const Picture& picture, int factor) {
  Picture out({std::max(1, picture.width() / factor), std::max(1, picture.height() / factor)},
              picture.channels());
  const int across = std::min(factor, picture.width()), down = std::min(factor, picture.height());
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      for (int c = 0; c < picture.channels(); ++c) {
        float sum = 0;
        for (int dy = 0; dy < down; ++dy) {
          for (int dx = 0; dx < across; ++dx)
            sum += picture.at(factor * x + dx, factor * y + dy, c);
        }
        out.at(x, y, c) = sum / static_cast<float>(across * down);
      }
    }
  }
  return out;
}

}  // namespace

BytePicture posterOf(const PlaneRow& coarsest, const Fit& fit, Response response,
                     std::span<const DirectionalLight> lights) {
  std::vector<float> basis(fit.basis.evaluateSize());
  fit.basis.evaluate(posterLight(lights), basis);

  const std::size_t pixels = coarsest.size.pixels();
  const auto planes = static_cast<std::size_t>(fit.basis.planes());
  Picture picture(coarsest.size, 3);
  const auto out = picture.samples();
  for (std::size_t p = 0; p < pixels; ++p) {
    const float coverage = coarsest.coverage.empty() ? 1.0f : coarsest.coverage[p];
    for (std::size_t c = 0; c < 3; ++c) {
      float sum = basis[3 * planes + c];
      for (std::size_t k = 0; k < planes; ++k) {
        sum += basis[3 * k + c] * coarsest.values[k * pixels + p];
      }
      out[3 * p + c] = sum;
    }
    applyResponse(response, out.subspan(3 * p, 3));
    for (std::size_t c = 0; c < 3; ++c) out[3 * p + c] *= coverage;
  }
  const int longer = std::max(picture.width(), picture.height());
  return displayBytes(scaledDown(picture, (longer + kPosterSide - 1) / kPosterSide));
}

}  // namespace illum
