#include "illum/evaluate.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "object/manifest.h"
#include "study/comparison.h"
#include "study/metrics.h"

namespace illum {
namespace {

/// How far two directions that were written down once may lie apart after rounding to five digits.
constexpr double kSameDirectionRadians = 1e-4;

/// Whether the fit never saw this light. The name alone does not decide: a stack of test
/// photographs often repeats the names of the first. The direction alone does not either: two
/// photographs may share one.
bool isHeldOut(const LightFileEntry& light, const Manifest& manifest) {
  bool fitted = false;
  for (int i = 0; i < static_cast<int>(manifest.lights.size()); ++i) {
    const LightFileEntry& other = manifest.lights[static_cast<std::size_t>(i)];
    const double apart = angleRadians(light.light.toLight, other.light.toLight);
    if (apart > kSameDirectionRadians) continue;
    const bool leftOut = std::count(manifest.heldOut.begin(), manifest.heldOut.end(), i) > 0;
    if (other.name == light.name) return leftOut;
    fitted = fitted || !leftOut;
  }
  return !fitted;
}

/// The figures of one light, gathered from the top of the picture to its bottom.
class LightJudge {
 public:
  LightJudge(Size size, std::span<const std::uint8_t> inside) : pictures_(size, inside) {}

  void add(const ComparedBand& band) {
    pictures_.addRows(band.relitBytes, band.photograph.bytes);
    const auto relit = band.relit.samples();
    const auto photograph = band.photograph.linear.samples();
    for (std::size_t i = 0; i < photograph.size(); ++i)
      linear_.add(double{relit[i]} - double{photograph[i]});
  }

  LightResult result(const LightFileEntry& light, const Manifest& manifest) const {
    const MaskedErrors errors = pictures_.errors();
    LightResult result;
    result.name = light.name;
    result.direction = light.light.toLight;
    result.heldOut = isHeldOut(light, manifest);
    result.all = errors.all;
    result.masked = errors.inside;
    result.linearRms = linear_.rms();
    result.linearPsnrDecibels = psnrDecibels(linear_.mean(), 1);
    return result;
  }

 private:
  PictureComparison pictures_;
  SquaredError linear_;
};

/// Per pixel 1 where coverage exceeds one half; empty without a mask.
std::vector<std::uint8_t> insideOf(const BytePicture& coverage) {
  std::vector<std::uint8_t> inside(coverage.samples().size());
  std::transform(coverage.samples().begin(), coverage.samples().end(), inside.begin(),
                 [](std::uint8_t covered) { return covered > 127; });
  return inside;
}

void addTo(PictureError& sum, const PictureError& error, double weight) {
  sum.psnrDecibels += weight * error.psnrDecibels;
  sum.ssim += weight * error.ssim;
  sum.rms += weight * error.rms;
}

ErrorSummary summarise(const std::vector<LightResult>& lights, bool heldOut) {
  ErrorSummary summary;
  for (const LightResult& light : lights) summary.lights += light.heldOut == heldOut;
  const double weight = 1.0 / std::max(1, summary.lights);
  for (const LightResult& light : lights) {
    if (light.heldOut != heldOut) continue;
    addTo(summary.all, light.all, weight);
    addTo(summary.masked, light.masked, weight);
    summary.linearRms += weight * light.linearRms;
    summary.linearPsnrDecibels += weight * light.linearPsnrDecibels;
  }
  return summary;
}

std::vector<LightResult> judgeAll(const Comparison& comparison, const Manifest& manifest,
                                  Progress& progress) {
  const std::vector<LightFileEntry>& lights = comparison.truth().lights();
  const Size size = comparison.truth().size();
  const std::vector<std::uint8_t> inside = insideOf(comparison.coverage());
  std::vector<int> indices(lights.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::vector<LightJudge> judges(lights.size(), LightJudge(size, inside));

  progress.begin("judging " + std::to_string(lights.size()) + " lights",
                 comparison.stepCount() * lights.size());
  comparison.forEachBand(indices, inside.size() + lights.size() * ssimScanBytes(size), progress,
                         [&](std::size_t i, const ComparedBand& band) { judges[i].add(band); });
  progress.end();

  std::vector<LightResult> results;
  for (std::size_t i = 0; i < lights.size(); ++i)
    results.push_back(judges[i].result(lights[i], manifest));
  return results;
}

}  // namespace

Evaluation evaluate(const Object& object, const Capture& truth, Progress& progress,
                    std::uint64_t memoryBytes) {
  const Comparison comparison(object, truth, memoryBytes);
  Evaluation evaluation;
  evaluation.lights = judgeAll(comparison, object.manifest(), progress);
  evaluation.used = summarise(evaluation.lights, false);
  evaluation.heldOut = summarise(evaluation.lights, true);
  evaluation.hasMask = !comparison.coverage().empty();
  evaluation.bytes = object.fileBytes();
  evaluation.bitsPerPixel =
      8 * static_cast<double>(evaluation.bytes) / static_cast<double>(object.size().pixels());
  return evaluation;
}

}  // namespace illum
