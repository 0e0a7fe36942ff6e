// format_sample FOLDER: writes small objects of several kinds, and expected.txt, what our own
// relighter makes of them: lines of an object, a view, a light, a pixel, its linear RGB and its
// depth (or "none"). The worked example of docs/format.md is held to it (check_reader.py).
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "encode/sample_object.h"
#include "illum/object.h"
#include "illum/relight.h"
#include "object/manifest.h"

namespace illum {
namespace {

struct Sample {
  std::string name;
  SampleOptions options;
};

std::vector<Sample> samples() {
  std::vector<Sample> all(9);
  all[0].name = "plain";
  all[1].name = "twelve_bits_display";
  all[1].options.bits = 12;
  all[1].options.response = Response::Display;
  all[2].name = "sixteen_bits_square_root";
  all[2].options.bits = 16;
  all[2].options.curve = Curve::SignedSqrt;
  all[3].name = "full_basis_cone";
  all[3].options.fullBasis = true;
  all[3].options.response = Response::Cone;
  all[4].name = "sphere";
  all[4].options.domain = LightDomain::Sphere;
  all[5].name = "full_basis_sphere_without_mask";
  all[5].options.fullBasis = true;
  all[5].options.domain = LightDomain::Sphere;
  all[5].options.mask = false;
  all[6].name = "views";
  all[6].options.views = sampleViews();
  all[6].options.bases = 2;
  all[6].options.depthSteps = 200;
  all[6].options.domain = LightDomain::Sphere;
  all[7].name = "views_fine_depth";
  all[7].options.views = sampleViews();
  all[7].options.depthSteps = 1000;
  all[8].name = "exact";
  all[8].options.exact = true;
  all[8].options.bits = 16;
  return all;
}

std::string depthAt(const Object& object, int group, int x, int y) {
  if (!object.hasDepth(group)) return "none";
  const int tile = object.manifest().tile;
  const auto grid = object.manifest().grid(group);
  const Rectangle area = grid.tileRectangle(0, x / tile, y / tile);
  const auto depths = object.depthTile(group, 0, x / tile, y / tile);
  const Size before{area.width, y - area.y};
  return std::to_string(depths[before.pixels() + static_cast<std::size_t>(x - area.x)]);
}

void writeExpected(const Sample& sample, const Object& object, std::ofstream& expected) {
  const Vector3 lights[] = {{0, 0, 1}, {0.3, -0.2, 0.9}, {-0.7, 0.7, 0.05},
                            {1, 0, 0}, {0.4, 0.8, -0.3}, {0, 0, -1}};
  const Relighter relighter(object);
  for (int group = 0; group < object.groups(); ++group) {
    const Size size = object.size(group);
    const int right = size.width - 1, bottom = size.height - 1;
    const int pixels[][2] = {
        {0, 0}, {right, bottom}, {std::min(63, right), std::min(64, bottom)}, {20, 10}};
    for (const Vector3& light : lights) {
      const DirectionalLight lamp{Direction::fromVector(light), {1, 1, 1}};
      const Picture picture = relighter.relight({&lamp, 1}, group);
      for (const auto& [x, y] : pixels)
        expected << sample.name << ' ' << group << ' ' << light.x << ' ' << light.y << ' '
                 << light.z << ' ' << x << ' ' << y << ' ' << picture.at(x, y, 0) << ' '
                 << picture.at(x, y, 1) << ' ' << picture.at(x, y, 2) << ' '
                 << depthAt(object, group, x, y) << '\n';
    }
  }
}

void write(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream expected(folder / "expected.txt");
  expected.precision(9);
  for (const Sample& sample : samples()) {
    const auto file = folder / (sample.name + ".illum");
    writeSampleObject(file, ObjectForm::Archive, sample.options);
    writeExpected(sample, Object::open(file), expected);
  }
}

}  // namespace
}  // namespace illum

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: format_sample FOLDER\n");
    return 2;
  }
  try {
    illum::write(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
