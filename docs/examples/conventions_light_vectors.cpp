// docs/conventions.md, "Light vectors".
#include "expect.h"
#include "illum/light_file.h"
#include "illum/vector.h"

#include <numbers>

using illum::Direction;
using illum::LightFile;

namespace {

constexpr double kPi = std::numbers::pi;

void anglesAndCoordinates() {
  const double theta = 0.4, phi = 2.1;
  const Direction light = Direction::fromAngles(theta, phi);
  expectNear(light.x(), std::sin(theta) * std::cos(phi), "x = sin theta cos phi");
  expectNear(light.y(), std::sin(theta) * std::sin(phi), "y = sin theta sin phi");
  expectNear(light.z(), std::cos(theta), "z = cos theta");
  expectNear(light.thetaRadians(), theta, "theta comes back");
  expectNear(light.phiRadians(), phi, "phi comes back");
}

void whereTheLightStands() {
  const Direction frontal = Direction::fromAngles(0, 0);
  const Direction fromTheRight = Direction::fromAngles(kPi / 2, 0);
  const Direction fromTheTop = Direction::fromAngles(kPi / 2, kPi / 2);
  const Direction fromBehind = Direction::fromAngles(kPi, 0);
  expectNear(frontal.z(), 1, "theta 0: light beside the camera");
  expectNear(fromTheRight.x(), 1, "phi 0: light on the right, shadows fall to the left");
  expectNear(fromTheTop.y(), 1, "phi 90 degrees: light at the top, shadows fall down");
  expectNear(fromBehind.z(), -1, "theta 180 degrees: light behind the object");
}

void lightFiles() {
  const LightFile lights = illum::parseLightFile(
      "2\n"
      "IMG_0001.jpg 0 0 1\n"
      "IMG_0002.jpg 0.6 0 0.8\n",
      "dome.lp");
  expect(lights.entries[0].light.toLight == Direction(), "the first light is frontal");
  expectNear(lights.entries[1].light.toLight.x(), 0.6, "the second stands to the right");
  expect(lights.entries[1].light.intensity.g == 1, "intensities are 1 unless the file says others");
}

}  // namespace

int main() {
  anglesAndCoordinates();
  whereTheLightStands();
  lightFiles();
}
