#include "study/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "illum/error.h"

namespace illum {
namespace {

std::string describe(const BytePicture& picture) {
  return std::to_string(picture.width()) + "x" + std::to_string(picture.height()) + " with " +
         std::to_string(picture.channels()) + " channels";
}

void checkComparable(const BytePicture& picture, const BytePicture& truth) {
  const bool alike = picture.size() == truth.size() && picture.channels() == truth.channels();
  const bool colour = truth.channels() == 1 || truth.channels() == 3;
  if (alike && colour && !truth.empty()) return;
  throw Error(Fault::Usage, "pictures to compare: expected one size and 1 or 3 channels, found " +
                                describe(picture) + " and " + describe(truth));
}

std::uint64_t squaredDifferences(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int difference = int{a[i]} - int{b[i]};
    sum += static_cast<std::uint64_t>(difference * difference);
  }
  return sum;
}

void addInside(const BytePicture& picture, const BytePicture& truth,
               std::span<const std::uint8_t> inside, SquaredError& error) {
  const auto channels = static_cast<std::size_t>(truth.channels());
  for (std::size_t pixel = 0; pixel < inside.size(); ++pixel) {
    if (inside[pixel] == 0) continue;
    const auto a = picture.samples().subspan(pixel * channels, channels);
    const auto b = truth.samples().subspan(pixel * channels, channels);
    error.addSum(static_cast<double>(squaredDifferences(a, b)), channels);
  }
}

PictureError figures(const SquaredError& error, double ssim) {
  return {psnrDecibels(error.mean(), 255), ssim, error.rms() / 255};
}

}  // namespace

double SquaredError::mean() const {
  if (samples_ == 0) return std::numeric_limits<double>::quiet_NaN();
  return sum_ / static_cast<double>(samples_);
}

double SquaredError::rms() const {
  return std::sqrt(mean());
}

double psnrDecibels(double meanSquaredError, double peak) {
  if (std::isnan(meanSquaredError)) return meanSquaredError;
  if (meanSquaredError <= 0) return kMaxPsnrDecibels;
  return std::min(kMaxPsnrDecibels, 10 * std::log10(peak * peak / meanSquaredError));
}

PictureComparison::PictureComparison(Size size, std::span<const std::uint8_t> inside)
    : size_(size), inside_(inside), ssim_(size) {}

void PictureComparison::addRows(const BytePicture& picture, const BytePicture& truth) {
  checkComparable(picture, truth);
  all_.addSum(static_cast<double>(squaredDifferences(picture.samples(), truth.samples())),
              truth.samples().size());
  if (!inside_.empty()) {
    const auto begin = Size{size_.width, rows_}.pixels();
    addInside(picture, truth, inside_.subspan(begin, truth.size().pixels()), masked_);
  }
  ssim_.addRows(picture, truth, inside_);
  rows_ += truth.height();
}

MaskedErrors PictureComparison::errors() const {
  const Ssim ssim = ssim_.means();
  return {figures(all_, ssim.all), figures(inside_.empty() ? all_ : masked_, ssim.inside)};
}

MaskedErrors comparePictures(const BytePicture& picture, const BytePicture& truth,
                             std::span<const std::uint8_t> inside) {
  checkComparable(picture, truth);
  PictureComparison comparison(truth.size(), inside);
  comparison.addRows(picture, truth);
  return comparison.errors();
}

PictureError comparePictures(const BytePicture& picture, const BytePicture& truth) {
  return comparePictures(picture, truth, {}).all;
}

}  // namespace illum
