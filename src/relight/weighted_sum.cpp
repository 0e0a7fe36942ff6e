#include "relight/weighted_sum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "illum/colour.h"

namespace illum {
namespace {

using Rgb = std::array<double, 3>;

struct PlaneColour {
  std::size_t plane, group;  // planes k, k + 3, … are one group
  Rgb weight;
};

// Weights that single precision would not tell from multiples of one colour are.
constexpr double kSameColour = 4e-7;

std::size_t largestChannel(const Rgb& weight) {
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::max_element(weight.begin(), weight.end(), smaller) -
                                  weight.begin());
}

// The colour of which all weights of a group are multiples, 1 in its largest channel; false if
// there is none.
bool commonColour(const std::vector<PlaneColour>& planes, std::size_t group, Rgb& colour,
                  std::size_t& channel) {
  const PlaneColour* strongest = nullptr;
  for (const PlaneColour& plane : planes) {
    if (plane.group != group) continue;
    if (strongest == nullptr || std::abs(plane.weight[largestChannel(plane.weight)]) >
                                    std::abs(strongest->weight[channel])) {
      strongest = &plane;
      channel = largestChannel(plane.weight);
    }
  }
  colour = {0, 0, 0};
  if (strongest == nullptr) return true;
  for (std::size_t c = 0; c < 3; ++c) colour[c] = strongest->weight[c] / strongest->weight[channel];
  return std::all_of(planes.begin(), planes.end(), [&](const PlaneColour& plane) {
    const double multiple = plane.weight[channel];
    for (std::size_t c = 0; c < 3 && plane.group == group; ++c) {
      if (!(std::abs(plane.weight[c] - multiple * colour[c]) <= kSameColour * std::abs(multiple)))
        return false;
    }
    return true;
  });
}

float offsetOf(const CodingEntry& coding, std::size_t plane) {
  return static_cast<float>(coding.offsets[plane]);
}

bool foldSeparable(const std::vector<PlaneColour>& planes, const CodingEntry& coding,
                   FoldedWeights& folded) {
  std::array<std::size_t, 3> channels{};
  for (std::size_t group = 0; group < 3; ++group) {
    Rgb colour{};
    if (!commonColour(planes, group, colour, channels[group])) return false;
    for (std::size_t c = 0; c < 3; ++c) folded.colours[group][c] = static_cast<float>(colour[c]);
  }
  for (const PlaneColour& p : planes) {
    const auto multiple = static_cast<float>(p.weight[channels[p.group]]);
    folded.separable[p.group].push_back(
        {static_cast<std::uint32_t>(p.plane), offsetOf(coding, p.plane), {multiple}});
  }
  return true;
}

void foldFull(const std::vector<PlaneColour>& planes, const CodingEntry& coding,
              FoldedWeights& folded) {
  for (const PlaneColour& p : planes) {
    WeightedPlane<3> weighted{static_cast<std::uint32_t>(p.plane), offsetOf(coding, p.plane), {}};
    for (std::size_t c = 0; c < 3; ++c) weighted.weight[c] = static_cast<float>(p.weight[c]);
    folded.planes.push_back(weighted);
  }
}

CodeRows rowsFrom(const TilePlanes& planes, const CodingEntry& coding, std::size_t texel) {
  CodeRows rows;
  rows.stride = planes.tile().pixels();
  rows.step = static_cast<float>(coding.step);
  rows.meaning = coding.curve == Curve::Half         ? CodeMeaning::Half
                 : coding.curve == Curve::SignedSqrt ? CodeMeaning::SignedSqrt
                                                     : CodeMeaning::Number;
  if (planes.inBytes())
    rows.bytes = planes.bytes() + texel;
  else
    rows.words = planes.words() + texel;
  return rows;
}

// linearFromDisplay of [0, 1] within 3e-8, for a power a sample would cost more than the sum.
// Values outside are clamped; what is not a number gives 0.
void decodeDisplay(std::span<float> samples) {
  constexpr std::size_t kSteps = 4096;
  static const std::array<float, kSteps + 1> kTable = [] {
    std::array<float, kSteps + 1> table{};
    for (std::size_t i = 0; i <= kSteps; ++i)
      table[i] = linearFromDisplay(static_cast<float>(i) / kSteps);
    return table;
  }();
  for (float& s : samples) {
    const float at = s > 0 ? std::min(s, 1.0F) * kSteps : 0;
    const auto below = std::min(static_cast<std::size_t>(at), kSteps - 1);
    const float share = at - static_cast<float>(below);
    s = kTable[below] + share * (kTable[below + 1] - kTable[below]);
  }
}

}  // namespace

FoldedWeights foldWeights(std::span<const double> basisValues, const CodingEntry& coding) {
  FoldedWeights folded;
  const bool linear = coding.curve == Curve::Linear;
  const auto mean = basisValues.last(3);
  Rgb constant{mean[0], mean[1], mean[2]};
  std::vector<PlaneColour> planes;
  for (std::size_t p = 0; p < coding.functions.size(); ++p) {
    const auto function = static_cast<std::size_t>(coding.functions[p]);
    PlaneColour plane{p, function % 3, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      const double b = basisValues[3 * function + c];
      plane.weight[c] = linear ? b * coding.step : b;
      if (linear) constant[c] += b * coding.offsets[p];
    }
    if (plane.weight != Rgb{0, 0, 0}) planes.push_back(plane);
  }
  folded.isSeparable = foldSeparable(planes, coding, folded);
  if (!folded.isSeparable) foldFull(planes, coding, folded);
  // -0 is what changes no sum, not even one of -0: a picture alone comes back to the last bit.
  for (std::size_t c = 0; c < 3; ++c)
    folded.constant[c] = constant[c] == 0 ? -0.0F : static_cast<float>(constant[c]);
  return folded;
}

FoldedWeights foldWeights(const LightBasis& basis, const CodingEntry& coding, Direction toLight) {
  std::vector<float> values(basis.evaluateSize());
  basis.evaluate(toLight, values);
  return foldWeights(std::vector<double>(values.begin(), values.end()), coding);
}

void weightedSum(const TilePlanes& planes, const CodingEntry& coding, const FoldedWeights& weights,
                 std::size_t first, std::span<float> rgb) {
  alignas(64) std::array<SumBlock, 3> blocks;
  const std::array<SumBlock*, 3> sums{&blocks[0], &blocks[1], &blocks[2]};
  const std::size_t texels = rgb.size() / 3;
  for (std::size_t begin = 0; begin < texels; begin += kSumBlock) {
    const std::size_t count = std::min(kSumBlock, texels - begin);
    const CodeRows codes = rowsFrom(planes, coding, first + begin);
    if (weights.isSeparable) {
      for (std::size_t k = 0; k < 3; ++k)
        sumWeighted(codes, weights.separable[k], count, -0.0F, blocks[k]);
      interleaveColoured(sums, weights.colours, weights.constant, count, rgb.data() + 3 * begin);
    } else {
      sumWeighted(codes, weights.planes, count, weights.constant, sums);
      interleave(sums, count, rgb.data() + 3 * begin);
    }
  }
}

void applyResponse(Response response, std::span<float> samples) {
  switch (response) {
    case Response::Linear:
      return;
    case Response::Display:
      decodeDisplay(samples);
      return;
    case Response::Cone:
      for (float& s : samples) s = std::max(s, 0.0f);
      return;
  }
}

}  // namespace illum
