#include "illum/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The figures of one picture, gathered from its top to its bottom.
class PictureJudge {
 public:
  PictureJudge(Size size, std::span<const std::uint8_t> inside) : pictures_(size, inside) {}

  void add(const ComparedBand& band) {
    pictures_.addRows(band.relitBytes, band.photograph.bytes);
    const auto relit = band.relit.samples();
    const auto photograph = band.photograph.linear.samples();
    for (std::size_t i = 0; i < photograph.size(); ++i)
      linear_.add(double{relit[i]} - double{photograph[i]});
  }

  PictureResult result(int view, int light) const {
    const MaskedErrors errors = pictures_.errors();
    return {
        {errors.all, errors.inside, linear_.rms(), psnrDecibels(linear_.mean(), 1)}, view, light};
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

/// Calls use(a's figure, b's figure, ...) for each figure.
template <typename Use, typename... Some>
void forEachFigure(Use use, Some&... some) {
  use(some.all.psnrDecibels...);
  use(some.all.ssim...);
  use(some.all.rms...);
  use(some.masked.psnrDecibels...);
  use(some.masked.ssim...);
  use(some.masked.rms...);
  use(some.linearRms...);
  use(some.linearPsnrDecibels...);
}

using Pictures = std::vector<const PictureResult*>;

/// Each figure's mean over the pictures that have it: a mask may leave some views empty.
Figures meanOf(const Pictures& pictures) {
  Figures weights, mean;
  if (pictures.empty()) return mean;
  for (const PictureResult* picture : pictures)
    forEachFigure([](double& count, double figure) { count += !std::isnan(figure); }, weights,
                  *picture);
  const auto start = [](double& weight, double& sum) {
    sum = weight > 0 ? 0 : std::numeric_limits<double>::quiet_NaN();
    weight = 1 / std::max(1.0, weight);
  };
  forEachFigure(start, weights, mean);
  const auto add = [](double& sum, double weight, double figure) {
    if (!std::isnan(figure)) sum += weight * figure;
  };
  for (const PictureResult* picture : pictures) forEachFigure(add, mean, weights, *picture);
  return mean;
}

/// Of the pictures of `first` to `last` (indices), those under lights that are held out or not.
ErrorSummary summarise(const Evaluation& evaluation, std::size_t first, std::size_t last,
                       bool heldOut) {
  Pictures chosen;
  for (std::size_t i = first; i < last; ++i) {
    const PictureResult& picture = evaluation.pictures[i];
    if (evaluation.lights[static_cast<std::size_t>(picture.light)].heldOut == heldOut)
      chosen.push_back(&picture);
  }
  const auto lights =
      std::count_if(evaluation.lights.begin(), evaluation.lights.end(),
                    [heldOut](const LightResult& light) { return light.heldOut == heldOut; });
  return {meanOf(chosen), static_cast<int>(lights)};
}

void addMeans(Evaluation& evaluation) {
  const std::size_t lights = evaluation.lights.size(), pictures = evaluation.pictures.size();
  for (std::size_t light = 0; light < lights; ++light) {
    Pictures under;
    for (std::size_t i = light; i < pictures; i += lights) under.push_back(&evaluation.pictures[i]);
    static_cast<Figures&>(evaluation.lights[light]) = meanOf(under);
  }
  for (std::size_t view = 0; view < evaluation.views.size(); ++view) {
    const std::size_t first = view * lights, last = first + lights;
    evaluation.views[view].used = summarise(evaluation, first, last, false);
    evaluation.views[view].heldOut = summarise(evaluation, first, last, true);
  }
  evaluation.used = summarise(evaluation, 0, pictures, false);
  evaluation.heldOut = summarise(evaluation, 0, pictures, true);
}

/// One view under all lights.
void judge(const Comparison& comparison, Progress& progress, Evaluation& evaluation) {
  const std::size_t lights = comparison.truth().lights().size();
  const Size size = comparison.size();
  const std::vector<std::uint8_t> inside = insideOf(comparison.coverage());
  std::vector<int> indices(lights);
  std::iota(indices.begin(), indices.end(), 0);
  std::vector<PictureJudge> judges(lights, PictureJudge(size, inside));
  comparison.forEachBand(indices, inside.size() + lights * ssimScanBytes(size), progress,
                         [&](std::size_t i, const ComparedBand& band) { judges[i].add(band); });
  for (const int light : indices)
    evaluation.pictures.push_back(
        judges[static_cast<std::size_t>(light)].result(comparison.view().truth, light));
  evaluation.hasMask = evaluation.hasMask || !comparison.coverage().empty();
}

void beginJudging(const std::vector<ViewPair>& views, const Object& object, const Capture& truth,
                  Progress& progress) {
  const std::size_t lights = truth.lights().size();
  std::uint64_t steps = 0;
  for (const ViewPair& view : views)
    steps += stepsDown(truth, view.truth, object.manifest().tile).size();
  const std::string under = std::to_string(lights) + " lights";
  progress.begin(
      "judging " +
          (views.size() == 1 ? under : std::to_string(views.size()) + " views under " + under),
      steps * lights);
}

double bitsPerPixelOf(const Object& object) {
  double pixels = 0;
  for (int group = 0; group < object.groups(); ++group)
    pixels += static_cast<double>(object.size(group).pixels());
  return 8 * static_cast<double>(object.fileBytes()) / pixels;
}

}  // namespace

Evaluation evaluate(const Object& object, const Capture& truth, Progress& progress,
                    std::uint64_t memoryBytes) {
  const std::vector<ViewPair> views = comparableViews(object, truth);
  Evaluation evaluation;
  for (const LightFileEntry& light : truth.lights())
    evaluation.lights.push_back(
        {{}, light.name, light.light.toLight, isHeldOut(light, object.manifest())});
  beginJudging(views, object, truth, progress);
  // One after the other: a capture of many views opens few of them at a time.
  for (const ViewPair& view : views) {
    const Comparison comparison(object, truth, view, memoryBytes);
    const std::string& name = truth.views()[static_cast<std::size_t>(view.truth)].name;
    evaluation.views.push_back({name, comparison.size(), {}, {}});
    judge(comparison, progress, evaluation);
  }
  progress.end();
  addMeans(evaluation);
  evaluation.bytes = object.fileBytes();
  evaluation.bitsPerPixel = bitsPerPixelOf(object);
  return evaluation;
}

}  // namespace illum
