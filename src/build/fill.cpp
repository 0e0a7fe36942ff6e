#include "build/fill.h"

#include <algorithm>
#include <vector>

namespace illum {
namespace {

struct Layer {
  Size size;
  std::vector<float> value, weight;
};

Size halved(Size size) {
  return {(size.width + 1) / 2, (size.height + 1) / 2};
}

// Pull: the weighted mean of each 2 x 2 block.
Layer coarser(const Layer& fine) {
  Layer coarse;
  coarse.size = halved(fine.size);
  coarse.value.assign(coarse.size.pixels(), 0);
  coarse.weight.assign(coarse.size.pixels(), 0);
  for (int y = 0; y < fine.size.height; ++y) {
    for (int x = 0; x < fine.size.width; ++x) {
      const auto from = static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.size.width) +
                        static_cast<std::size_t>(x);
      const auto to =
          static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(coarse.size.width) +
          static_cast<std::size_t>(x / 2);
      coarse.value[to] += fine.weight[from] * fine.value[from];
      coarse.weight[to] += fine.weight[from];
    }
  }
  for (std::size_t i = 0; i < coarse.value.size(); ++i) {
    if (coarse.weight[i] > 0) coarse.value[i] /= coarse.weight[i];
    coarse.weight[i] = std::min(coarse.weight[i], 1.0f);
  }
  return coarse;
}

// Push: what has no weight of its own takes the coarser layer, bilinearly.
void refill(Layer& fine, const Layer& coarse) {
  const auto sample = [&](int x, int y) {
    x = std::clamp(x, 0, coarse.size.width - 1);
    y = std::clamp(y, 0, coarse.size.height - 1);
    return coarse.value[static_cast<std::size_t>(y) * static_cast<std::size_t>(coarse.size.width) +
                        static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < fine.size.height; ++y) {
    for (int x = 0; x < fine.size.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.size.width) +
                     static_cast<std::size_t>(x);
      const float own = fine.weight[i];
      if (own >= 1) continue;
      const int besideX = x / 2 + (x % 2 == 0 ? -1 : 1), besideY = y / 2 + (y % 2 == 0 ? -1 : 1);
      const float pushed = 0.5625f * sample(x / 2, y / 2) +
                           0.1875f * (sample(besideX, y / 2) + sample(x / 2, besideY)) +
                           0.0625f * sample(besideX, besideY);
      fine.value[i] = own * fine.value[i] + (1 - own) * pushed;
    }
  }
}

}  // namespace

void fillHidden(std::span<float> planes, std::span<const float> coverage, Size size) {
  if (std::none_of(coverage.begin(), coverage.end(), [](float c) { return c <= 0; })) return;
  const std::size_t pixels = size.pixels();
  for (std::size_t begin = 0; begin < planes.size(); begin += pixels) {
    std::vector<Layer> layers(1);
    layers[0].size = size;
    layers[0].value.assign(planes.begin() + static_cast<std::ptrdiff_t>(begin),
                           planes.begin() + static_cast<std::ptrdiff_t>(begin + pixels));
    layers[0].weight.resize(pixels);
    std::transform(coverage.begin(), coverage.end(), layers[0].weight.begin(),
                   [](float c) { return c > 0 ? 1.0f : 0.0f; });
    while (layers.back().size.pixels() > 1) layers.push_back(coarser(layers.back()));
    for (std::size_t i = layers.size() - 1; i-- > 0;) refill(layers[i], layers[i + 1]);
    const bool nothing = layers.back().weight[0] <= 0;
    for (std::size_t p = 0; p < pixels; ++p) {
      planes[begin + p] = nothing ? 0.0f : layers[0].value[p];
    }
  }
}

}  // namespace illum
