// fly_around_slab OBJECT.illum FOLDER: a round through the view points of a light slab, with a lamp
// that goes round the other way, as eight pictures 0.png … 7.png.
#include "illum/error.h"
#include "illum/lumigraph.h"
#include "illum/picture_io.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    illum::Lumigraph object(illum::Object::open(argv[1]));
    const auto slab = std::get<illum::SlabView>(object.object().view(0).geometry).slab;
    for (int frame = 0; frame < 8; ++frame) {
      const double x = std::cos(0.785 * frame), y = std::sin(0.785 * frame);
      const std::array lights{illum::DirectionalLight{illum::Direction::fromVector({-x, -y, 1})}};
      object.setLights(lights);
      const auto eye = slab.objectFromSlab.point(slab.viewPoint(0.5 + 0.3 * x, 0.5 + 0.3 * y));
      const auto camera = illum::cameraLookingAt(eye, object.middle(), 40, {320, 240});
      illum::writePicture(std::filesystem::path(argv[2]) / (std::to_string(frame) + ".png"),
                          object.see(camera).picture);
    }
  } catch (const illum::Error& error) {
    std::fprintf(stderr, "fly_around_slab: %s\n", error.what());
    return 1;
  }
}
