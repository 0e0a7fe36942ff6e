// light_with_panorama OBJECT.illum PANORAMA.exr PICTURE.png: lit by what is around, turned by 90
// degrees, and by a candle.
#include "illum/error.h"
#include "illum/picture_io.h"
#include "illum/relight.h"

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    const illum::Relighter relighter(illum::Object::open(argv[1]));
    illum::EnvironmentLight around;
    around.picture = argv[2];
    around.rotationDegrees = 90;
    illum::PointLight candle;
    candle.position = {0.5, 0.5, 1};
    candle.intensity = {0.1F, 0.06F, 0.02F};
    const auto lights = relighter.prepare(illum::illuminationOf({{around, candle}}));
    illum::writePicture(argv[3], relighter.relight(lights));
  } catch (const illum::Error& error) {
    std::fprintf(stderr, "light_with_panorama: %s\n", error.what());
    return 1;
  }
}
