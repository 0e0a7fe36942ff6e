// Error measures between two pictures (docs/quality.md, "How the figures are defined").
#pragma once

#include <cstdint>
#include <span>

#include "illum/evaluate.h"
#include "illum/picture.h"
#include "study/ssim.h"

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

/// Compares two pictures that arrive from the top, a few rows at a time.
class PictureComparison {
 public:
  /// `inside`: per pixel of the whole picture, not 0 where it counts for MaskedErrors::inside;
  /// empty: everywhere. It must outlive *this.
  PictureComparison(Size size, std::span<const std::uint8_t> inside);

  /// The next rows, whole width. Both have one size and 1 or 3 channels each alike; throws Error
  /// (Fault::Usage) otherwise.
  void addRows(const BytePicture& picture, const BytePicture& truth);

  /// Of the rows so far. Figures over no pixel at all are NaN.
  MaskedErrors errors() const;

 private:
  Size size_;
  std::span<const std::uint8_t> inside_;
  int rows_ = 0;
  SquaredError all_, masked_;
  SsimScan ssim_;
};

/// Of whole pictures.
MaskedErrors comparePictures(const BytePicture& picture, const BytePicture& truth,
                             std::span<const std::uint8_t> inside);

}  // namespace illum
