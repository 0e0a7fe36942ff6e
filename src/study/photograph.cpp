#include "study/photograph.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "illum/colour.h"

namespace illum {
namespace {

/// Enough to make a step worthwhile; with all that is made of them, about 30 MB.
constexpr int kStepPixels = 1 << 19;
/// Of a rendered capture, lights times pixels: 50 MB of samples.
constexpr std::size_t kStepSamples = std::size_t{1} << 22;

int pixelsOfStep(const Capture& capture) {
  if (!capture.isRendered()) return kStepPixels;
  const std::size_t lights = std::max<std::size_t>(1, capture.lights().size());
  return static_cast<int>(std::min<std::size_t>(kStepPixels, kStepSamples / lights));
}

/// One sample as it was photographed: linear, and as a byte.
struct Shown {
  float linear = 0;
  std::uint8_t byte = 0;
};

/// linearFromDisplay; the values of 8-bit files, which most are, without the power.
float linearFromSample(float sample) {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> linear{};
    for (std::size_t byte = 0; byte < linear.size(); ++byte)
      linear[byte] = linearFromDisplay(static_cast<float>(byte) / 255);
    return linear;
  }();
  const std::uint8_t byte = byteFromUnit(sample);
  return sample == static_cast<float>(byte) / 255 ? kLinear[byte] : linearFromDisplay(sample);
}

/// A factor of exactly 1 keeps the byte of a display-referred file out of the way of any rounding.
Shown shownSample(float sample, Transfer transfer, float factor) {
  if (transfer == Transfer::Display && factor == 1)
    return {linearFromSample(sample), byteFromUnit(sample)};
  const float linear = factor * (transfer == Transfer::Display ? linearFromSample(sample) : sample);
  return {linear, displayByteFromLinear(linear)};
}

/// Planar samples of one channel into the interleaved band.
void showChannel(std::span<const float> samples, std::span<const std::uint8_t> coverage,
                 Transfer transfer, float intensity, std::size_t channel, PhotographBand& band) {
  for (std::size_t pixel = 0; pixel < samples.size(); ++pixel) {
    const float covered = coverage.empty() ? 1 : static_cast<float>(coverage[pixel]) / 255;
    const Shown shown = shownSample(samples[pixel], transfer, intensity * covered);
    band.linear.samples()[3 * pixel + channel] = shown.linear;
    band.bytes.samples()[3 * pixel + channel] = shown.byte;
  }
}

}  // namespace

std::vector<Rectangle> stepsDown(const Capture& capture, int view, int tileRows) {
  const Size size = capture.size(view);
  const int most = std::max(1, pixelsOfStep(capture) / std::max(1, size.width));
  const int bandRows = std::max(1, capture.bandRows());
  std::vector<Rectangle> steps;
  for (int y = 0; y < size.height; y += steps.back().height) {
    const int toBand = bandRows - y % bandRows, toTile = tileRows - y % tileRows;
    steps.push_back({0, y, size.width, std::min({most, toBand, toTile, size.height - y})});
  }
  return steps;
}

PhotographBand readPhotograph(const Capture& capture, int view, int light, const Rectangle& rows,
                              const BytePicture& coverage) {
  std::vector<float> samples(3 * rows.pixels());
  capture.read(view, rows, {&light, 1}, samples);
  return photographOf(samples, capture, light, rows, coverage);
}

PhotographBand photographOf(std::span<const float> samples, const Capture& capture, int light,
                            const Rectangle& rows, const BytePicture& coverage) {
  const LinearRgb intensity = capture.lights().at(static_cast<std::size_t>(light)).light.intensity;
  const std::array<float, 3> factors{intensity.r, intensity.g, intensity.b};
  PhotographBand band{rows, Picture(rows.size(), 3), BytePicture(rows.size(), 3)};
  std::span<const std::uint8_t> covered = coverage.samples();
  if (!covered.empty()) covered = covered.subspan(Size{rows.width, rows.y}.pixels(), rows.pixels());
  for (std::size_t c = 0; c < 3; ++c)
    showChannel(samples.subspan(c * rows.pixels(), rows.pixels()), covered, capture.transfer(),
                factors[c], c, band);
  return band;
}

BytePicture coverageOf(const Capture& capture, int view) {
  if (!capture.hasMask()) return {};
  BytePicture coverage(capture.size(view), 1);
  for (const Rectangle& rows : stepsDown(capture, view, capture.size(view).height)) {
    std::vector<float> band(rows.pixels());
    capture.readMask(view, rows, band);
    const auto out = coverage.samples().subspan(Size{rows.width, rows.y}.pixels(), rows.pixels());
    std::transform(band.begin(), band.end(), out.begin(), byteFromUnit);
  }
  return coverage;
}

}  // namespace illum
