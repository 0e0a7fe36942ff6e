#include "illum/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "illum/error.h"
#include "illum/picture_io.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

LinearRgb product(LinearRgb a, LinearRgb b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

}  // namespace

Direction directionFromMap(double u, double v) {
  const double longitude = 2 * kPi * (u - 0.5), latitude = kPi * (0.5 - v);
  return Direction::fromVector({std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                -std::cos(longitude) * std::cos(latitude)});
}

double texelSolidAngle(int row, Size map) {
  const double top = kPi * (0.5 - static_cast<double>(row) / map.height);
  const double bottom = kPi * (0.5 - (row + 1.0) / map.height);
  return 2 * kPi / map.width * (std::sin(top) - std::sin(bottom));
}

RigidTransform objectFromMap(double rotationDegrees, Direction up) {
  const Direction y = Direction::fromVector({0, 1, 0});
  const RigidTransform turn = rotationAbout(y, rotationDegrees * kPi / 180);
  const double angle = angleRadians(y, up);
  if (angle == 0) return turn;
  const Vector3 axis = cross(y.vector(), up.vector());
  // Upside down there is no smallest rotation: about z, so that right and left change places.
  const bool opposite = length(axis) < 1e-12;
  return rotationAbout(Direction::fromVector(opposite ? Vector3{0, 0, 1} : axis), angle) * turn;
}

Environment::Environment(Picture radiance, const RigidTransform& objectFromMap, LinearRgb scale)
    : radiance_(std::move(radiance)), objectFromMap_(objectFromMap), scale_(scale) {
  const Size size = radiance_.size();
  if (size.height < 1 || size.width != 2 * size.height) {
    throw Error(Fault::Input, fmt::format("expected an equirectangular map, twice as wide as high, "
                                          "found {} x {}",
                                          size.width, size.height));
  }
  const auto samples = radiance_.samples();
  const auto wrong =
      std::find_if_not(samples.begin(), samples.end(), [](float s) { return std::isfinite(s); });
  if (wrong != samples.end()) {
    const auto pixel = static_cast<std::size_t>(wrong - samples.begin()) /
                       static_cast<std::size_t>(radiance_.channels());
    const auto width = static_cast<std::size_t>(size.width);
    throw Error(Fault::Input, fmt::format("expected finite radiance, found {} at column {}, row {}",
                                          *wrong, pixel % width, pixel / width));
  }
}

LinearRgb Environment::scaled(int column, int row) const {
  const float r = radiance_.at(column, row, 0);
  if (radiance_.channels() < 3) return product(scale_, {r, r, r});
  return product(scale_, {r, radiance_.at(column, row, 1), radiance_.at(column, row, 2)});
}

DirectionalLight Environment::texel(int column, int row) const {
  const Direction inMap =
      directionFromMap((column + 0.5) / size().width, (row + 0.5) / size().height);
  const auto share = static_cast<float>(texelSolidAngle(row, size()) / kPi);
  return {objectFromMap_.direction(inMap), share * scaled(column, row)};
}

LinearRgb Environment::radianceFrom(Direction d) const {
  const Direction inMap = inverse(objectFromMap_).direction(d);
  const double u = 0.5 + std::atan2(inMap.x(), -inMap.z()) / (2 * kPi);
  const double v = 0.5 - std::asin(std::clamp(inMap.y(), -1.0, 1.0)) / kPi;
  const int column = static_cast<int>(u * size().width) % size().width;
  return scaled(column, std::min(static_cast<int>(v * size().height), size().height - 1));
}

Environment Environment::turned(const RigidTransform& rotation) const {
  return Environment(radiance_, rotation * objectFromMap_, scale_);
}

Environment readEnvironment(const EnvironmentLight& light) {
  Picture radiance = readPicture(light.picture);
  const auto exposure = static_cast<float>(std::exp2(light.exposureStops));
  try {
    return Environment(std::move(radiance), objectFromMap(light.rotationDegrees, light.up),
                       exposure * light.intensity);
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", light.picture.string(), error.what()));
  }
}

}  // namespace illum
