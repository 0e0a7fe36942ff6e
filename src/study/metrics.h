// Error measures between two pictures (docs/quality.md, "How the figures are defined").
#pragma once

#include <cstdint>
#include <span>

#include "illum/evaluate.h"
#include "illum/picture.h"

namespace illum {

/// What identical pictures get, and the most that any get.
inline constexpr double kMaxPsnrDecibels = 99;

/// Adds up squared differences. The mean of none is NaN: such a figure does not exist.
class SquaredError {
 public:
  void add(double difference) { addSum(difference * difference, 1); }
  void addSum(double sumOfSquares, std::uint64_t samples) {
    sum_ += sumOfSquares;
    samples_ += samples;
  }
  double mean() const;
  double rms() const;

 private:
  double sum_ = 0;
  std::uint64_t samples_ = 0;
};

/// 10 log10(peak^2 / mean squared error), at most kMaxPsnrDecibels. NaN for NaN.
double psnrDecibels(double meanSquaredError, double peak);

/// A picture's errors over all of it, and over the part that a mask covers.
struct MaskedErrors {
  PictureError all, inside;
};

/// `inside`: per pixel, not 0 where it counts for `.inside`; empty: `.inside` equals `.all`.
/// Figures over no pixel at all are NaN. Both pictures have one size and 1 or 3 channels each
/// alike; throws Error (Fault::Usage) otherwise.
MaskedErrors comparePictures(const BytePicture& picture, const BytePicture& truth,
                             std::span<const std::uint8_t> inside);

}  // namespace illum
