// docs/conventions.md, "Radiometry".
#include "expect.h"
#include "illum/light.h"

#include <algorithm>
#include <numbers>

using illum::Direction;
using illum::DirectionalLight;
using illum::LinearRgb;
using illum::Vector3;

namespace {

constexpr double kPi = std::numbers::pi;

/// What is stored of a photograph: the value that light of intensity 1 would have given.
double reflectance(double pixelValue, double intensity) {
  return pixelValue / intensity;
}

/// A Lambertian surface under a directional light: albedo / pi times the irradiance, which is
/// pi * intensity * cos(angle of incidence).
double lambertian(double albedo, Direction normal, const DirectionalLight& light) {
  const double cosine = std::max(0.0, dot(normal.vector(), light.toLight.vector()));
  return albedo / kPi * (kPi * light.intensity.g * cosine);
}

/// A point light as it acts on `point`: from there, with the square of the distance.
DirectionalLight seenFrom(Vector3 point, Vector3 position, LinearRgb intensity) {
  const Vector3 toLight = position - point;
  const auto falloff = static_cast<float>(1 / dot(toLight, toLight));
  return {Direction::fromVector(toLight), falloff * intensity};
}

/// Equirectangular maps: u to the right, v down, both in [0, 1].
Direction directionFromMap(double u, double v) {
  const double longitude = 2 * kPi * (u - 0.5), latitude = kPi * (0.5 - v);
  return Direction::fromVector({std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                -std::cos(longitude) * std::cos(latitude)});
}

/// Of one texel in the given row.
double solidAngle(int row, int width, int height) {
  const double top = kPi * (0.5 - static_cast<double>(row) / height);
  const double bottom = kPi * (0.5 - (row + 1.0) / height);
  return 2 * kPi / width * (std::sin(top) - std::sin(bottom));
}

/// A texel of an environment map as a directional light.
DirectionalLight texelLight(double radiance, int column, int row, int width, int height) {
  const auto intensity = static_cast<float>(radiance * solidAngle(row, width, height) / kPi);
  return {directionFromMap((column + 0.5) / width, (row + 0.5) / height),
          {intensity, intensity, intensity}};
}

}  // namespace

int main() {
  expect(reflectance(0.6, 2) == 0.3, "a photograph under twice the light shows twice the value");
  const DirectionalLight frontal{Direction(), {1, 1, 1}};
  expectNear(lambertian(1, Direction(), frontal), 1, "a white surface facing light 1 has value 1");

  const DirectionalLight lamp = seenFrom({0, 0, 0}, {0, 0, 2}, {8, 8, 8});
  expect(lamp.intensity.g == 2 && lamp.toLight.z() == 1, "a point light of 8 at 2 units acts as 2");

  expectNear(directionFromMap(0.5, 0.5).z(), -1, "the picture's centre is -z");
  expectNear(directionFromMap(0.75, 0.5).x(), 1, "u increases toward +x");
  expectNear(directionFromMap(0.5, 0).y(), 1, "the top is +y");

  // The white furnace: under radiance 1 from everywhere a white surface has radiance 1.
  constexpr int kWidth = 256, kHeight = 128;
  const Direction normal = Direction::fromAngles(0.7, 0.3);
  double sphere = 0, white = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      sphere += solidAngle(row, kWidth, kHeight);
      white += lambertian(1, normal, texelLight(1, column, row, kWidth, kHeight));
    }
  expectNear(sphere, 4 * kPi, "all texels cover the sphere", 1e-9);
  expectNear(white, 1, "the white furnace", 1e-4);
}
