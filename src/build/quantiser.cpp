#include "build/quantiser.h"

#include <Imath/half.h>
#include <cblas.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "illum/colour.h"
#include "illum/error.h"

namespace illum {
namespace {

// Pixels on which a candidate is tried, and samples of all trials together.
constexpr std::size_t kTrialPixels = 16384, kLeastTrialPixels = 1024;
constexpr std::size_t kTrialSamples = kTrialPixels * 128;

// Stored planes may be this many times the basis planes, when ranges are split over several.
constexpr double kMaxSplit = 2.0;

using Range = QuantiserTrial::Range;
using Ranges = std::vector<Range>;

constexpr double kLosslessDecibels = 99;  // as `evaluate` prints identical pictures

double curved(Curve curve, double value) {
  return curve == Curve::Linear ? value : std::copysign(std::sqrt(std::abs(value)), value);
}

// The stored planes for a step: as many for each basis plane as its range needs.
CodingEntry entryFor(const QuantiserRequest& request, Curve curve, int bits, double step,
                     const Ranges& ranges, bool mayRepeat) {
  CodingEntry entry;
  entry.coding = request.coding;
  entry.bits = bits;
  entry.curve = curve;
  entry.step = step;
  const double span = step * ((1 << bits) - 1);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const int parts =
        mayRepeat ? std::max(1, static_cast<int>(std::ceil(ranges[k].length() / span - 1e-9))) : 1;
    for (int part = 0; part < parts; ++part) {
      entry.functions.push_back(static_cast<int>(k));
      entry.offsets.push_back(part == 0 ? ranges[k].low : 0);
    }
  }
  return entry;
}

double longest(const std::vector<Ranges>& rangesOfBases) {
  double length = 0;
  for (const Ranges& ranges : rangesOfBases)
    for (const Range& range : ranges) length = std::max(length, range.length());
  // Constant planes still need a step that is a number.
  return std::max(length, 1e-6);
}

// What a screen shows of a plane combination, unrounded.
float onScreen(Response response, float value) {
  if (response == Response::Display) return std::clamp(value, 0.0f, 1.0f);
  return displayFromLinear(std::clamp(value, 0.0f, 1.0f));
}

std::vector<Ranges> rangesOf(std::span<const QuantiserTrial> trials, Curve curve) {
  std::vector<Ranges> ranges;
  for (const QuantiserTrial& trial : trials) ranges.push_back(trial.ranges(curve));
  return ranges;
}

// All bases with the same bits, curve and step.
QuantiserChoice tried(std::span<const QuantiserTrial> trials, const QuantiserRequest& request,
                      Curve curve, int bits, double step, const std::vector<Ranges>& ranges,
                      bool mayRepeat) {
  QuantiserChoice choice;
  for (std::size_t b = 0; b < trials.size(); ++b) {
    choice.entries.push_back(entryFor(request, curve, bits, step, ranges[b], mayRepeat));
    choice.decibels += trials[b].decibels(choice.entries.back());
  }
  choice.decibels /= static_cast<double>(trials.size());
  return choice;
}

// Whether no basis needs more stored planes than is worth while.
bool isSlim(const QuantiserChoice& choice, const std::vector<Ranges>& ranges) {
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    const auto most = static_cast<std::size_t>(kMaxSplit * static_cast<double>(ranges[b].size()));
    if (choice.entries[b].functions.size() > most) return false;
  }
  return true;
}

// The coarsest step that reaches the target with as many stored planes as it takes (up to
// kMaxSplit).
QuantiserChoice splitRanges(std::span<const QuantiserTrial> trials, const QuantiserRequest& request,
                            const std::vector<Ranges>& ranges, int bits) {
  QuantiserChoice choice;
  double step = longest(ranges) / ((1 << bits) - 1);
  for (int attempt = 0; attempt < 6; ++attempt) {
    QuantiserChoice next = tried(trials, request, Curve::Linear, bits, step, ranges, true);
    if (attempt > 0 && !isSlim(next, ranges)) return choice;
    const double decibels = next.decibels;
    if (attempt == 0 || decibels > choice.decibels) choice = std::move(next);
    if (decibels >= request.targetDecibels) return choice;
    // Uniform quantising: the error goes with the step.
    step *= std::pow(10.0, (decibels - request.targetDecibels - 0.2) / 20);
  }
  return choice;
}

// The nearest halves, ties to even (IEEE 754); what is beyond the largest becomes that.
PlaneCodes halves(const CodingEntry& entry, std::span<const float> planes, Size tile,
                  std::uint64_t& clipped) {
  constexpr float kLargestHalf = 65504;
  const std::size_t pixels = tile.pixels(), stored = entry.functions.size();
  PlaneCodes codes{static_cast<int>(stored), tile, std::vector<std::uint16_t>(stored * pixels)};
  for (std::size_t p = 0; p < stored; ++p) {
    const float* plane = planes.data() + static_cast<std::size_t>(entry.functions[p]) * pixels;
    for (std::size_t i = 0; i < pixels; ++i) {
      const float value = std::clamp(plane[i], -kLargestHalf, kLargestHalf);
      if (value != plane[i]) ++clipped;
      codes.values[p * pixels + i] = Imath::half(value).bits();
    }
  }
  return codes;
}

}  // namespace

QuantiserTrial::QuantiserTrial(const Fit& fit, std::span<const DirectionalLight> lights,
                               Response response, std::span<const float> planes, std::size_t pixels,
                               bool complete, std::size_t trials)
    : response_(response),
      planeCount_(fit.basis.planes()),
      complete_(complete),
      lights_(lights.size()) {
  for (std::size_t begin = 0; begin < planes.size(); begin += pixels) {
    const auto [low, high] = std::ranges::minmax(planes.subspan(begin, pixels));
    low_.push_back(low);
    high_.push_back(high);
  }
  const std::size_t most =
      std::clamp(kTrialSamples / (lights_ * trials), kLeastTrialPixels, kTrialPixels);
  const std::size_t stride = std::max<std::size_t>(1, pixels / most);
  for (std::size_t p = 0; p < pixels; p += stride) ++pixels_;
  for (std::size_t k = 0; k < static_cast<std::size_t>(planeCount_); ++k) {
    for (std::size_t p = 0; p < pixels; p += stride) values_.push_back(planes[k * pixels + p]);
  }
  std::vector<float> b(fit.basis.evaluateSize());
  for (const DirectionalLight& light : lights) {
    fit.basis.evaluate(light.toLight, b);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(planeCount_); ++k) {
        weights_.push_back(b[3 * k + c]);
      }
      mean_.push_back(b[3 * static_cast<std::size_t>(planeCount_) + c]);
    }
  }
  truth_ = shown(values_);
}

std::vector<QuantiserTrial::Range> QuantiserTrial::ranges(Curve curve) const {
  std::vector<Range> ranges;
  for (std::size_t k = 0; k < low_.size(); ++k) {
    Range range{curved(curve, static_cast<double>(low_[k])),
                curved(curve, static_cast<double>(high_[k]))};
    // A selection has not seen the extremes.
    const double margin = complete_ ? 0 : 0.1 * range.length();
    ranges.push_back({range.low - margin, range.high + margin});
  }
  return ranges;
}

double QuantiserTrial::decibels(const CodingEntry& entry) const {
  std::uint64_t clipped = 0;
  const Size size{static_cast<int>(pixels_), 1};
  const auto codes = quantise(entry, values_, size, clipped);
  const auto trial = shown(dequantise(entry, codes, planeCount_));
  double sum = 0;
  const std::size_t perLight = 3 * pixels_;
  for (std::size_t l = 0; l < lights_; ++l) {
    double squares = 0;
    for (std::size_t i = l * perLight; i < (l + 1) * perLight; ++i) {
      const double d = static_cast<double>(trial[i]) - static_cast<double>(truth_[i]);
      squares += d * d;
    }
    sum +=
        std::min(99.0, -10 * std::log10(std::max(1e-12, squares / static_cast<double>(perLight))));
  }
  return sum / static_cast<double>(lights_);
}

std::vector<float> QuantiserTrial::shown(const std::vector<float>& values) const {
  const auto rows = static_cast<int>(3 * lights_), columns = static_cast<int>(pixels_);
  std::vector<float> out(3 * lights_ * pixels_);
  cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, rows, columns, planeCount_, 1.0f,
              weights_.data(), planeCount_, values.data(), columns, 0.0f, out.data(), columns);
  for (std::size_t row = 0; row < 3 * lights_; ++row) {
    for (std::size_t p = 0; p < pixels_; ++p) {
      float& value = out[row * pixels_ + p];
      value = onScreen(response_, value + mean_[row]);
    }
  }
  return out;
}

QuantiserChoice chooseQuantiser(std::span<const QuantiserTrial> trials,
                                const QuantiserRequest& request) {
  const auto plain = [&](Curve curve, int bits) {
    const auto ranges = rangesOf(trials, curve);
    const double step = longest(ranges) / ((1 << bits) - 1);
    return tried(trials, request, curve, bits, step, ranges, false);
  };
  if (request.bits) return plain(request.curve.value_or(Curve::Linear), *request.bits);

  if (request.coding == Coding::Png) {
    QuantiserChoice choice;
    for (const int bits : {8, 10, 12, 16}) {
      choice = plain(request.curve.value_or(Curve::Linear), bits);
      if (choice.decibels >= request.targetDecibels) break;
    }
    return choice;
  }
  if (request.curve == Curve::SignedSqrt) return plain(Curve::SignedSqrt, 8);
  QuantiserChoice choice = splitRanges(trials, request, rangesOf(trials, Curve::Linear), 8);
  if (request.curve || choice.decibels >= request.targetDecibels) return choice;
  QuantiserChoice root = plain(Curve::SignedSqrt, 8);
  return root.decibels > choice.decibels ? root : choice;
}

bool areWholeBytes(std::span<const float> samples) {
  return std::ranges::all_of(samples, [](float value) {
    const float code = std::round(255 * value);
    return code >= 0 && code <= 255 && std::abs(code / 255 - value) < 1e-6F;
  });
}

QuantiserChoice exactQuantiser(std::size_t bases, int planes, bool bytes,
                               const QuantiserRequest& request) {
  if (request.bits || request.curve)
    throw Error(Fault::Usage,
                "--basis exact: its samples are kept as they are; expected neither --bits nor "
                "--curve");
  CodingEntry entry;
  entry.coding = request.coding;
  entry.bits = bytes ? 8 : 16;
  entry.curve = bytes ? Curve::Linear : Curve::Half;
  entry.step = bytes ? 1.0 / 255 : 1;
  entry.offsets.assign(static_cast<std::size_t>(planes), 0);
  for (int k = 0; k < planes; ++k) entry.functions.push_back(k);
  QuantiserChoice choice;
  choice.decibels = kLosslessDecibels;
  choice.entries.assign(bases, entry);
  return choice;
}

PlaneCodes quantise(const CodingEntry& entry, std::span<const float> planes, Size tile,
                    std::uint64_t& clipped) {
  const std::size_t pixels = tile.pixels(), stored = entry.functions.size();
  if (entry.curve == Curve::Half) return halves(entry, planes, tile, clipped);
  const double top = (1 << entry.bits) - 1;
  PlaneCodes codes{static_cast<int>(stored), tile, std::vector<std::uint16_t>(stored * pixels)};
  for (std::size_t p = 0; p < stored;) {
    const auto function = static_cast<std::size_t>(entry.functions[p]);
    std::size_t parts = 1;
    while (p + parts < stored && entry.functions[p + parts] == entry.functions[p]) ++parts;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double s = curved(entry.curve, static_cast<double>(planes[function * pixels + i]));
      const double whole = std::round((s - entry.offsets[p]) / entry.step);
      const double most = static_cast<double>(parts) * top;
      if (whole < 0 || whole > most) ++clipped;
      double rest = std::clamp(whole, 0.0, most);
      for (std::size_t part = 0; part < parts; ++part) {
        const double code = std::min(rest, top);
        codes.values[(p + part) * pixels + i] = static_cast<std::uint16_t>(code);
        rest -= code;
      }
    }
    p += parts;
  }
  return codes;
}

std::vector<float> dequantise(const CodingEntry& entry, const PlaneCodes& codes, int basisPlanes) {
  const std::size_t pixels = codes.tile.pixels();
  std::vector<float> planes(static_cast<std::size_t>(basisPlanes) * pixels);
  for (std::size_t p = 0; p < entry.functions.size(); ++p) {
    const auto function = static_cast<std::size_t>(entry.functions[p]);
    for (std::size_t i = 0; i < pixels; ++i)
      planes[function * pixels + i] +=
          static_cast<float>(valueOfCode(entry, p, codes.values[p * pixels + i]));
  }
  return planes;
}

}  // namespace illum
