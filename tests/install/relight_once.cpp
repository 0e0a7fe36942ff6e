// relight_once OBJECT.illum PICTURE.png: a warm light from the left and a cool one from the right.

#include <array>
#include <cstdio>

#include "illum/error.h"
#include "illum/object.h"
#include "illum/picture_io.h"
#include "illum/relight.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const illum::Relighter relighter(illum::Object::open(argv[1]));
    const std::array lights = {
        illum::DirectionalLight{illum::Direction::fromVector({-1, 0.5, 1}), {1.0f, 0.8f, 0.6f}},
        illum::DirectionalLight{illum::Direction::fromVector({1, 0.5, 1}), {0.3f, 0.4f, 0.6f}},
    };
    illum::writePicture(argv[2], relighter.relight(lights));
  } catch (const illum::Error& error) {
    std::fprintf(stderr, "relight_once: %s\n", error.what());
    return 1;
  }
}
