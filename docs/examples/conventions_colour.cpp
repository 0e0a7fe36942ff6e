// docs/conventions.md, "Colour".
#include "expect.h"
#include "illum/colour.h"
#include "illum/picture.h"

using illum::BytePicture;
using illum::LinearRgb;
using illum::Picture;

namespace {

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decoded(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

void transferFunction() {
  for (int i = 0; i <= 100; ++i) {
    const double value = i / 100.0;
    expectNear(illum::displayFromLinear(static_cast<float>(value)), encoded(value), "sRGB", 1e-7);
    expectNear(illum::linearFromDisplay(static_cast<float>(value)), decoded(value), "and back",
               1e-7);
  }
  expect(illum::displayFromLinear(-0.5F) == -illum::displayFromLinear(0.5F), "odd below zero");
}

void whatAScreenShows() {
  Picture linear({3, 1}, 1);
  linear.at(0, 0, 0) = 0.18F;
  linear.at(1, 0, 0) = 4;
  linear.at(2, 0, 0) = -1;
  const BytePicture shown = displayBytes(linear, /*exposureStops=*/0);
  expect(shown.at(0, 0, 0) == 118, "mid grey: 255 * 0.4614, rounded to nearest");
  expect(shown.at(1, 0, 0) == 255, "no tone mapping: what is brighter than white is white");
  expect(shown.at(2, 0, 0) == 0, "what is darker than black is black");
  const BytePicture darker = displayBytes(linear, /*exposureStops=*/-2);
  expect(darker.at(1, 0, 0) == 255, "two stops less: 4 becomes 1");
}

void lightAdds() {
  const LinearRgb red{0.2F, 0, 0}, white{0.3F, 0.3F, 0.3F};
  expect(red + 2 * white == LinearRgb{0.8F, 0.6F, 0.6F}, "only linear light may be added");
}

}  // namespace

int main() {
  transferFunction();
  whatAScreenShows();
  lightAdds();
}
