#include "build/plan.h"

#include <fmt/format.h>

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

FitOptions fitOptionsFrom(const BuildOptions& options) {
  FitOptions fit;
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
  std::vector<float> planes(static_cast<std::size_t>(basis.fit.basis.planes()) * pilot.pixels);
  basis.fit.planes.apply(pilot.samples, pilot.pixels, planes);
  return {basis.fit, basis.directions, response, planes, pilot.pixels, pilot.complete, trials};
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
  const FitOptions fitOptions = fitOptionsFrom(options);
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
    const Pilot pilot = drawPilot(capture, frame.groups, lights.used,
                                  pilotPixels(capture, pixelsOf(capture, frame),
                                              static_cast<int>(lights.used.size()), memoryBytes) /
                                      frames.size(),
                                  progress);
    progress.begin("choosing the light basis", 1);
    basis.fit = fitBasis(basis.directions, statisticsOf(pilot), fitOptions);
    if (exact)
      bytes = bytes && areWholeBytes(pilot.samples);
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
