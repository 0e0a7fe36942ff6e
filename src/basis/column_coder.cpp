#include "basis/column_coder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace illum::basisfile {
namespace {

// Of a column's largest magnitude, in field units: leaves room below kMaxFieldValue for
// predictions.
constexpr double kLargestField = 1 << 24;
// Codes round toward zero below this fraction of a step: a little more error, far more zeros (the
// best of 0.33 to 0.5 by bytes at equal error, docs/math/bases.md).
constexpr double kRoundingThreshold = 0.62;

// The smallest unit that is at least `atLeast`.
int unitCodeFrom(double atLeast) {
  if (!(atLeast > 0)) return 0;
  int exponent = 0;
  const double mantissa = std::frexp(atLeast, &exponent);  // in [1/2, 1)
  const int code = static_cast<int>(std::ceil(32 * mantissa - 16)) + 16 * (exponent - 5 + 96);
  return std::clamp(code, 0, kMaxUnitCode);
}

}  // namespace

TableShape::TableShape(const BasisTable& table)
    : resolution(table.resolution()),
      squares(table.squares()),
      samples(static_cast<std::size_t>(table.side()) * table.side()),
      inDisc(samples, 0),
      order(resolution) {
  const std::int64_t radius = resolution - 1;
  for (int row = 1; row <= resolution; ++row) {
    for (int column = 1; column <= resolution; ++column) {
      const std::int64_t x = 2 * (column - 1) - radius, y = 2 * (row - 1) - radius;
      if (x * x + y * y > radius * radius) continue;
      inDisc[static_cast<std::size_t>(row) * (resolution + 2) + column] = 1;
      ++discSamples;
    }
  }
}

double TableShape::rmsOverDisc(std::span<const float> values) const {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (inDisc[i % samples] != 0) sum += static_cast<double>(values[i]) * values[i];
  }
  return std::sqrt(sum / static_cast<double>(squares * discSamples));
}

// The least-squares weight of the reference.
void ColumnCoder::setTarget(const CodedColumn* reference, int distance) {
  reference_ = reference;
  scale_ = {};
  double weight = 0;
  if (reference != nullptr) {
    double product = 0, square = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      product += static_cast<double>(values_[i]) * reference->values[i];
      square += static_cast<double>(reference->values[i]) * reference->values[i];
    }
    const double code = square > 0 ? std::round(product / square * kWeightScale) : 0;
    scale_.weightCode = static_cast<std::int16_t>(std::clamp(code, -32767.0, 32767.0));
    scale_.referenceDistance = static_cast<std::uint8_t>(distance);
    weight = scale_.weight();
  }
  largest_ = pole_ == nullptr ? 0 : std::abs(*pole_ - weight * (reference ? reference->pole : 0));
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const double rest = values_[i] - weight * (reference ? reference->values[i] : 0);
    largest_ = std::max(largest_, std::abs(rest));
  }
}

CodedColumn ColumnCoder::codeWithin(double error, const CodedColumn* reference, int distance) {
  setTarget(reference, distance);
  // A step of one and a half times the error keeps it whatever the values are: no rounding error
  // exceeds kRoundingThreshold steps. From there up to 128 times as much is tried.
  int low = unitCodeFrom(1.5 * error / unitsPerCode(0));
  low = std::max(low, unitCodeFrom(largest_ / kLargestField));
  int high = std::min(low + 16 * 7, kMaxUnitCode + 1);
  CodedColumn best, trial;
  code(low, best);
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    code(middle, trial);
    if (trial.rmsError <= error) {
      low = middle;
      std::swap(best, trial);
    } else {
      high = middle;
    }
  }
  return best;
}

void ColumnCoder::code(int unitCode, CodedColumn& out) {
  scale_.unitCode = static_cast<std::uint16_t>(unitCode);
  out.scale = scale_;
  out.codes.clear();
  out.values.assign(values_.size(), 0.0F);
  double squaredError = 0;
  for (int square = 0; square < shape_.squares; ++square) squaredError += codeSquare(square, out);
  out.rmsError = std::sqrt(squaredError / static_cast<double>(shape_.squares * shape_.discSamples));
  if (pole_ != nullptr) codePole(out);
  // Stands for the entropy: an Elias gamma code's length, within a bit or so of what deflate
  // reaches.
  out.cost = reference_ == nullptr ? 0 : 16;
  for (const std::int32_t c : out.codes) out.cost += 2 * std::log2(1.0 + 2.0 * std::abs(c));
}

// Returns the sum of squared errors over the disc.
double ColumnCoder::codeSquare(int square, CodedColumn& out) {
  const double unit = scale_.unit(), weight = scale_.weight();
  const std::size_t base = square * shape_.samples;
  double sum = 0;
  for (const CodingStep& step : shape_.order.steps) {
    const std::size_t i = base + step.sample;
    const float reference = reference_ == nullptr ? 0.0F : reference_->values[i];
    const std::int32_t units = unitsPerCode(step.level), prediction = predict(step, field_);
    const double rest = ((values_[i] - weight * reference) / unit - prediction) / units;
    const double magnitude = std::floor(std::abs(rest) + (1 - kRoundingThreshold));
    const auto code = static_cast<std::int32_t>(std::copysign(magnitude, rest));
    field_[step.sample] = prediction + units * code;
    out.codes.push_back(code);
    out.values[i] = static_cast<float>(valueOf(field_[step.sample], unit, weight, reference));
    const double error = static_cast<double>(out.values[i]) - values_[i];
    if (shape_.inDisc[step.sample] != 0) sum += error * error;
  }
  return sum;
}

void ColumnCoder::codePole(CodedColumn& out) {
  const double unit = scale_.unit(), weight = scale_.weight();
  const float reference = reference_ == nullptr ? 0.0F : reference_->pole;
  const std::int32_t prediction = predictPole(field_, shape_.resolution);
  const double rest = ((*pole_ - weight * reference) / unit - prediction) / kPoleUnitsPerCode;
  const auto code = static_cast<std::int32_t>(std::lround(rest));
  out.codes.push_back(code);
  out.pole =
      static_cast<float>(valueOf(prediction + kPoleUnitsPerCode * code, unit, weight, reference));
}

}  // namespace illum::basisfile
