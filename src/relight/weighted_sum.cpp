#include "relight/weighted_sum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "illum/colour.h"

namespace illum {
namespace {

// Texels worked on at a time: three accumulators of this length stay in the first-level cache while
// all planes pass by.
constexpr std::size_t kBlock = 1024;

struct Accumulator {
  std::array<std::array<float, kBlock>, 3> channel;

  void add(const float* values, std::size_t count, const std::array<float, 3>& weight) {
    for (std::size_t c = 0; c < 3; ++c) {
      float* sum = channel[c].data();
      const float w = weight[c];
      for (std::size_t i = 0; i < count; ++i) sum[i] += w * values[i];
    }
  }
};

// What the weights of foldWeights are to be multiplied by.
void planeValues(const std::uint16_t* codes, std::size_t count, const CodingEntry& coding,
                 std::size_t plane, float* values) {
  if (coding.curve == Curve::Linear) {
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(codes[i]);
    return;
  }
  const auto step = static_cast<float>(coding.step);
  const auto offset = static_cast<float>(coding.offsets[plane]);
  for (std::size_t i = 0; i < count; ++i) {
    const float s = offset + step * static_cast<float>(codes[i]);
    values[i] = s * std::abs(s);
  }
}

}  // namespace

FoldedWeights foldWeights(std::span<const double> basisValues, const CodingEntry& coding) {
  FoldedWeights folded;
  folded.perPlane.resize(coding.functions.size());
  const auto mean = basisValues.last(3);
  std::array<double, 3> constant{mean[0], mean[1], mean[2]};
  for (std::size_t p = 0; p < coding.functions.size(); ++p) {
    const auto function = static_cast<std::size_t>(coding.functions[p]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double b = basisValues[3 * function + c];
      if (coding.curve == Curve::Linear) {
        folded.perPlane[p][c] = static_cast<float>(b * coding.step);
        constant[c] += b * coding.offsets[p];
      } else {
        folded.perPlane[p][c] = static_cast<float>(b);
      }
    }
  }
  for (std::size_t c = 0; c < 3; ++c) folded.constant[c] = static_cast<float>(constant[c]);
  return folded;
}

FoldedWeights foldWeights(const LightBasis& basis, const CodingEntry& coding, Direction toLight) {
  std::vector<float> values(basis.evaluateSize());
  basis.evaluate(toLight, values);
  return foldWeights(std::vector<double>(values.begin(), values.end()), coding);
}

void weightedSum(const PlaneCodes& codes, const CodingEntry& coding, const FoldedWeights& weights,
                 std::size_t first, std::span<float> rgb) {
  Accumulator sums;
  std::array<float, kBlock> values;
  const std::size_t texels = rgb.size() / 3;
  for (std::size_t begin = 0; begin < texels; begin += kBlock) {
    const std::size_t count = std::min(kBlock, texels - begin);
    for (std::size_t c = 0; c < 3; ++c) sums.channel[c].fill(weights.constant[c]);
    for (std::size_t p = 0; p < weights.perPlane.size(); ++p) {
      const auto plane = codes.plane(static_cast<int>(p));
      planeValues(plane.data() + first + begin, count, coding, p, values.data());
      sums.add(values.data(), count, weights.perPlane[p]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < 3; ++c) rgb[3 * (begin + i) + c] = sums.channel[c][i];
    }
  }
}

void applyResponse(Response response, std::span<float> samples) {
  switch (response) {
    case Response::Linear:
      return;
    case Response::Display:
      for (float& s : samples) s = linearFromDisplay(std::clamp(s, 0.0f, 1.0f));
      return;
    case Response::Cone:
      for (float& s : samples) s = std::max(s, 0.0f);
      return;
  }
}

}  // namespace illum
