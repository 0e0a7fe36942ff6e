// relight_photograph OBJECT.illum PICTURE.png: a warm lamp on the left, a weak cool one right.
#include "illum/error.h"
#include "illum/picture_io.h"
#include "illum/relight.h"

#include <array>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const illum::Relighter relighter(illum::Object::open(argv[1]));
    const std::array lights{
        illum::DirectionalLight{illum::Direction::fromVector({-1, 0.5, 1}), {1.0F, 0.8F, 0.6F}},
        illum::DirectionalLight{illum::Direction::fromVector({1, 0.5, 1}), {0.1F, 0.15F, 0.2F}},
    };
    illum::writePicture(argv[2], relighter.relight(lights));
  } catch (const illum::Error& error) {
    std::fprintf(stderr, "relight_photograph: %s\n", error.what());
    return 1;
  }
}
