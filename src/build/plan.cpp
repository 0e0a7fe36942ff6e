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
  throw Error(Fault::Usage,
              fmt::format("--basis: expected learned, sh, hsh or dct, found \"{}\"", name));
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
  request.coding = codingFromName(options.coding);
  request.bits = options.bits;
  if (options.curve) request.curve = curveFromName(*options.curve);
  return request;
}

}  // namespace

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

Plan planObject(const Capture& capture, const LightChoice& lights, const BuildOptions& options,
                Response response, std::uint64_t memoryBytes, Progress& progress) {
  const FitOptions fitOptions = fitOptionsFrom(options);
  const QuantiserRequest request = quantiserRequestFrom(options);

  const auto most = pilotPixels(static_cast<int>(lights.used.size()), memoryBytes);
  const Pilot pilot = drawPilot(capture, lights.used, most, progress);
  progress.begin("choosing the light basis", 1);
  Plan plan;
  plan.fit = fitBasis(lights.directions, statisticsOf(pilot), fitOptions);
  std::vector<float> planes(static_cast<std::size_t>(plan.fit.basis.planes()) * pilot.pixels);
  plan.fit.planes.apply(pilot.samples, pilot.pixels, planes);
  plan.quantiser = chooseQuantiser(plan.fit, lights.directions, response, planes, pilot.pixels,
                                   pilot.complete, request);
  progress.end();
  return plan;
}

}  // namespace illum
