#include "build/plan.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "build/pilot.h"
#include "illum/error.h"

namespace illum {
namespace {

BasisFamily familyFromName(const std::string& name) {
  if (name == "learned") return BasisFamily::Learned;
  if (name == "sh") return BasisFamily::SphericalHarmonics;
  if (name == "hsh") return BasisFamily::HemisphericalHarmonics;
  if (name == "dct") return BasisFamily::Cosine;
  if (name == "exact") return BasisFamily::Exact;
  throw Error(Fault::Usage,
              fmt::format("--basis: expected learned, sh, hsh, dct or exact, found \"{}\"", name));
}

Curve curveFromName(const std::string& name) {
  if (name == "linear") return Curve::Linear;
  if (name == "signedSqrt") return Curve::SignedSqrt;
  throw Error(Fault::Usage,
              fmt::format("--curve: expected linear or signedSqrt, found \"{}\"", name));
}

FitOptions fitOptionsFrom(const BuildOptions& options, Response response) {
  FitOptions fit;
  fit.displayReferred = response == Response::Display;
  fit.family = familyFromName(options.basis);
  fit.coefficients = options.coefficients;
  fit.planes = options.planes;
  fit.solidAngleWeights = options.solidAngleWeights;
  fit.extension = options.extension;
  fit.regularizer = options.regularizer;
  fit.projection = options.projection;
  return fit;
}

QuantiserRequest quantiserRequestFrom(const BuildOptions& options) {
  QuantiserRequest request;
  request.coding = codingOf(options);
  request.bits = options.bits;
  if (options.curve) request.curve = curveFromName(*options.curve);
  return request;
}

std::uint64_t pixelsOf(const Capture& capture, const TurnedFrame& frame) {
  std::uint64_t pixels = 0;
  for (const int group : frame.groups) pixels += capture.size(group).pixels();
  return pixels;
}

QuantiserTrial trialOf(const PlannedBasis& basis, const Pilot& pilot, Response response,
                       std::size_t trials) {
  const auto count = static_cast<std::size_t>(basis.fit.basis.planes());
  std::vector<float> planes(count * pilot.pixels);
  std::vector<std::size_t> firstPixel;
  for (std::size_t first = 0; const Pilot::Block& block : pilot.blocks) {
    firstPixel.push_back(first);
    first += block.pixels;
  }
  tbb::parallel_for(std::size_t{0}, pilot.blocks.size(), [&](std::size_t i) {
    const Pilot::Block& block = pilot.blocks[i];
    std::vector<float> ofBlock(count * block.pixels);
    basis.fit.planes.apply(pilot.samples(block), block.pixels, ofBlock);
    for (std::size_t k = 0; k < count; ++k)
      std::copy_n(ofBlock.data() + k * block.pixels, block.pixels,
                  planes.data() + k * pilot.pixels + firstPixel[i]);
  });
  return {basis.fit, basis.directions, response, planes, pilot.pixels, pilot.complete, trials};
}

// Whether photographs' samples are as they were in a file of bytes.
bool isOfWholeBytes(const Pilot& pilot) {
  return std::ranges::all_of(
      pilot.blocks, [&](const Pilot::Block& block) { return areWholeBytes(pilot.samples(block)); });
}

}  // namespace

Coding codingOf(const BuildOptions& options) {
  const bool exact = options.basis == "exact";
  if (options.coding.empty()) return exact ? Coding::Png : Coding::Avif;
  const Coding coding = codingFromName(options.coding);
  if (exact && coding != Coding::Png)
    throw Error(Fault::Usage, fmt::format("--basis exact: expected the lossless coding png, found "
                                          "{}",
                                          options.coding));
  return coding;
}

LightChoice chooseLights(const Capture& capture, int holdout) {
  LightChoice choice;
  const auto& lights = capture.lights();
  for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
    if (holdout > 0 && i % holdout == holdout - 1) {
      choice.heldOut.push_back(i);
    } else {
      choice.used.push_back(i);
      choice.directions.push_back(lights[static_cast<std::size_t>(i)].light);
    }
  }
  if (choice.used.empty()) {
    throw Error(Fault::Usage, fmt::format("--holdout {}: leaves none of the {} lights to fit",
                                          holdout, lights.size()));
  }
  return choice;
}

double Plan::leaveOneOutDecibels() const {
  double sum = 0, views = 0;
  for (const PlannedBasis& basis : bases) {
    const auto count = static_cast<double>(basis.frame.groups.size());
    sum += count * basis.fit.leaveOneOutDecibels;
    views += count;
  }
  return sum / views;
}

Plan planObject(const Capture& capture, const LightChoice& lights, const BuildOptions& options,
                Response response, std::uint64_t memoryBytes, Progress& progress) {
  const FitOptions fitOptions = fitOptionsFrom(options, response);
  const QuantiserRequest request = quantiserRequestFrom(options);
  const std::vector<TurnedFrame> frames = framesOf(capture.views());
  if (frames.size() > static_cast<std::size_t>(kMaxBases)) {
    throw Error(Fault::Input,
                fmt::format("expected views turned in at most {} ways, for each needs a light "
                            "basis of its own, found {}",
                            kMaxBases, frames.size()));
  }
  Plan plan;
  const bool exact = fitOptions.family == BasisFamily::Exact;
  bool bytes = response == Response::Display;
  std::vector<QuantiserTrial> trials;
  for (const TurnedFrame& frame : frames) {
    PlannedBasis& basis = plan.bases.emplace_back();
    basis.frame = frame;
    basis.directions = frame.turned(lights.directions);
    const Pilot pilot =
        drawPilot(capture, frame.groups, lights.used,
                  pilotPixels(capture, pixelsOf(capture, frame),
                              static_cast<int>(lights.used.size()), frames.size(), memoryBytes),
                  progress);
    progress.begin("choosing the light basis", 1);
    basis.fit = fitBasis(basis.directions, statisticsOf(pilot), fitOptions);
    if (exact)
      bytes = bytes && isOfWholeBytes(pilot);
    else
      trials.push_back(trialOf(basis, pilot, response, frames.size()));
    progress.end();
  }
  // The same lights give as many planes in every frame.
  plan.quantiser =
      exact ? exactQuantiser(frames.size(), plan.bases[0].fit.basis.planes(), bytes, request)
            : chooseQuantiser(trials, request);
  return plan;
}

}  // namespace illum
