#include "light/median_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

namespace illum {
namespace {

double luminance(LinearRgb c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// How much light of a map lies in a rectangle, in constant time. Light that is less than none, as
/// some maps have it, counts as much as light.
class SummedLight {
 public:
  explicit SummedLight(const Environment& environment) : width_(environment.size().width + 1) {
    const Size size = environment.size();
    sums_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(size.height + 1));
    for (int row = 0; row < size.height; ++row) {
      double inRow = 0;
      for (int column = 0; column < size.width; ++column) {
        inRow += std::abs(luminance(environment.texel(column, row).intensity));
        at(column + 1, row + 1) = at(column + 1, row) + inRow;
      }
    }
  }
  double in(const Rectangle& r) const {
    return at(r.right(), r.bottom()) - at(r.x, r.bottom()) - at(r.right(), r.y) + at(r.x, r.y);
  }

 private:
  double& at(int x, int y) {
    return sums_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x)];
  }
  double at(int x, int y) const { return const_cast<SummedLight*>(this)->at(x, y); }

  int width_;
  std::vector<double> sums_;
};

struct Region {
  double light;
  Rectangle texels;
  friend bool operator<(const Region& a, const Region& b) { return a.light < b.light; }
};

/// The part of `whole` left of (above) the line that halves its light; never empty, never all.
Rectangle half(const SummedLight& light, const Rectangle& whole, bool across) {
  Rectangle part = whole;
  int low = 1, high = (across ? whole.width : whole.height) - 1;
  const double wanted = light.in(whole) / 2;
  while (low < high) {
    const int middle = (low + high) / 2;
    (across ? part.width : part.height) = middle;
    if (light.in(part) < wanted)
      low = middle + 1;
    else
      high = middle;
  }
  (across ? part.width : part.height) = low;
  return part;
}

DirectionalLight lightOf(const Environment& environment, const Rectangle& texels) {
  Vector3 centroid;
  double r = 0, g = 0, b = 0;
  for (int row = texels.y; row < texels.bottom(); ++row) {
    for (int column = texels.x; column < texels.right(); ++column) {
      const DirectionalLight light = environment.texel(column, row);
      const double weight = std::abs(luminance(light.intensity));
      centroid = centroid + weight * light.toLight.vector();
      r += light.intensity.r;
      g += light.intensity.g;
      b += light.intensity.b;
    }
  }
  return {Direction::fromVector(centroid),
          {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)}};
}

}  // namespace

std::vector<DirectionalLight> medianCut(const Environment& environment, int regions) {
  const SummedLight light(environment);
  const Size size = environment.size();
  const Rectangle all{0, 0, size.width, size.height};
  std::priority_queue<Region> open;
  std::vector<Rectangle> done;
  if (light.in(all) > 0) open.push({light.in(all), all});
  while (!open.empty() && static_cast<int>(open.size() + done.size()) < regions) {
    const Rectangle whole = open.top().texels;
    open.pop();
    if (whole.pixels() == 1) {
      done.push_back(whole);
      continue;
    }
    const double latitude = std::numbers::pi * (0.5 - (whole.y + whole.height / 2.0) / size.height);
    const bool across =
        whole.height == 1 || (whole.width > 1 && whole.width * std::cos(latitude) > whole.height);
    const Rectangle first = half(light, whole, across);
    const Rectangle second =
        across ? Rectangle{first.right(), whole.y, whole.width - first.width, whole.height}
               : Rectangle{whole.x, first.bottom(), whole.width, whole.height - first.height};
    for (const Rectangle& part : {first, second})
      if (light.in(part) > 0) open.push({light.in(part), part});
  }
  for (; !open.empty(); open.pop()) done.push_back(open.top().texels);
  std::vector<DirectionalLight> lights;
  for (const Rectangle& texels : done) lights.push_back(lightOf(environment, texels));
  return lights;
}

}  // namespace illum
