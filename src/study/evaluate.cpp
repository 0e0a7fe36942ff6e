#include "illum/evaluate.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "core/memory.h"
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

/// How the memory that judging may take is shared out.
struct MemoryPlan {
  std::uint64_t tileBytes = 0;  ///< for the object's decoded tiles
  int lightsAtOnce = 1;
};

MemoryPlan planMemory(const Object& object, const Capture& truth, std::uint64_t memoryBytes) {
  const std::uint64_t pixels = truth.size().pixels();
  const std::uint64_t most = memoryBytes > 0 ? memoryBytes : machineMemoryBytes() / 4;
  const std::uint64_t codes = pixels * static_cast<std::uint64_t>(object.planes()) * 2;
  MemoryPlan plan;
  plan.tileBytes = std::min(most / 2, codes);

  // A light holds its relit picture with and without alpha in floats, and both pictures in bytes.
  const std::uint64_t perLight = pixels * (7 * sizeof(float) + 6) + photographBandBytes(truth) + 1;
  const std::uint64_t held = plan.tileBytes + truth.residentBytes();
  const std::uint64_t fitting = most > held ? (most - held) / perLight : 0;
  const auto threads = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency());
  plan.lightsAtOnce = static_cast<int>(std::clamp<std::uint64_t>(fitting, 1, threads));
  return plan;
}

void addLinear(const Picture& relit, const PhotographBand& band, SquaredError& error) {
  for (int y = 0; y < band.rows.height; ++y) {
    const auto a = relit.row(band.rows.y + y);
    const auto b = band.linear.row(y);
    for (std::size_t i = 0; i < b.size(); ++i) error.add(double{a[i]} - double{b[i]});
  }
}

LightResult judge(const Comparison& comparison, int light, std::span<const std::uint8_t> inside) {
  const Picture relit = comparison.relit(light);
  BytePicture photograph(relit.size(), 3);
  SquaredError linear;
  comparison.readPhotograph(light, [&](const PhotographBand& band) {
    const auto bytes = band.bytes.samples();
    std::copy(bytes.begin(), bytes.end(), photograph.row(band.rows.y).begin());
    addLinear(relit, band, linear);
  });
  const MaskedErrors errors = comparePictures(displayBytes(relit), photograph, inside);

  const LightFileEntry& entry = comparison.truth().lights()[static_cast<std::size_t>(light)];
  LightResult result;
  result.name = entry.name;
  result.direction = entry.light.toLight;
  result.all = errors.all;
  result.masked = errors.inside;
  result.linearRms = linear.rms();
  result.linearPsnrDecibels = psnrDecibels(linear.mean(), 1);
  return result;
}

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

/// Every light once, each read from its top to its bottom, `atOnce` side by side.
std::vector<LightResult> judgeAll(const Comparison& comparison, int atOnce, Progress& progress) {
  const std::vector<std::uint8_t> inside = insideOf(comparison.coverage());
  std::vector<LightResult> results(comparison.truth().lights().size());
  tbb::task_arena arena(atOnce);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t light) {
      // Isolated: a thread that waits inside must not begin another light and hold two.
      tbb::this_task_arena::isolate(
          [&] { results[light] = judge(comparison, static_cast<int>(light), inside); });
      progress.advance();
    });
  });
  return results;
}

}  // namespace

Evaluation evaluate(const Object& object, const Capture& truth, Progress& progress,
                    std::uint64_t memoryBytes) {
  const MemoryPlan plan = planMemory(object, truth, memoryBytes);
  const Comparison comparison(object, truth, plan.tileBytes);
  progress.begin("judging " + std::to_string(truth.lights().size()) + " lights",
                 truth.lights().size());
  Evaluation evaluation;
  evaluation.lights = judgeAll(comparison, plan.lightsAtOnce, progress);
  progress.end();

  for (std::size_t i = 0; i < evaluation.lights.size(); ++i)
    evaluation.lights[i].heldOut = isHeldOut(truth.lights()[i], object.manifest());
  evaluation.used = summarise(evaluation.lights, false);
  evaluation.heldOut = summarise(evaluation.lights, true);
  evaluation.hasMask = !comparison.coverage().empty();
  evaluation.bytes = object.fileBytes();
  evaluation.bitsPerPixel =
      8 * static_cast<double>(evaluation.bytes) / static_cast<double>(object.size().pixels());
  return evaluation;
}

}  // namespace illum
