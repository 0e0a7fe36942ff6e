#include "light/median_cut.h"

#include <algorithm>
#include <array>
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

/// Of the same light on either side; across the longer side, by the circles that rows are.
std::array<Rectangle, 2> halves(const SummedLight& light, const Rectangle& whole, Size size) {
  const double latitude = std::numbers::pi * (0.5 - (whole.y + whole.height / 2.0) / size.height);
  const bool across =
      whole.height == 1 || (whole.width > 1 && whole.width * std::cos(latitude) > whole.height);
  const Rectangle first = half(light, whole, across);
  if (across) return {first, {first.right(), whole.y, whole.width - first.width, whole.height}};
  return {first, {whole.x, first.bottom(), whole.width, whole.height - first.height}};
}

}  // namespace

void MedianCut::addTexels(const Environment& environment, Node& node) const {
  for (int row = node.texels.y; row < node.texels.bottom(); ++row) {
    for (int column = node.texels.x; column < node.texels.right(); ++column) {
      const DirectionalLight light = environment.texel(column, row);
      const double weight = std::abs(luminance(light.intensity));
      node.centroid = node.centroid + weight * light.toLight.vector();
      node.r += light.intensity.r;
      node.g += light.intensity.g;
      node.b += light.intensity.b;
    }
  }
}

MedianCut::MedianCut(const Environment& environment, int mostRegions) {
  const SummedLight light(environment);
  const Size size = environment.size();
  const auto less = [this](int a, int b) {
    const Node &x = nodes_[static_cast<std::size_t>(a)], &y = nodes_[static_cast<std::size_t>(b)];
    return x.light != y.light ? x.light < y.light : a > b;
  };
  std::priority_queue<int, std::vector<int>, decltype(less)> open(less);
  const auto push = [&](const Rectangle& texels) {
    const double inside = light.in(texels);
    if (!(inside > 0)) return -1;
    nodes_.push_back({texels, inside, -1, -1, {}, 0, 0, 0});
    open.push(static_cast<int>(nodes_.size()) - 1);
    return static_cast<int>(nodes_.size()) - 1;
  };
  push({0, 0, size.width, size.height});
  int single = 0;  // regions that cannot be halved
  while (!open.empty() && static_cast<int>(open.size()) + single < mostRegions) {
    const int index = open.top();
    open.pop();
    const Rectangle whole = nodes_[static_cast<std::size_t>(index)].texels;
    if (whole.pixels() == 1) {
      ++single;
      continue;
    }
    const auto [first, second] = halves(light, whole, size);
    const int one = push(first), other = push(second);
    nodes_[static_cast<std::size_t>(index)].first = one;
    nodes_[static_cast<std::size_t>(index)].second = other;
    halved_.push_back(index);
  }
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    if (node->first < 0 && node->second < 0) {
      addTexels(environment, *node);
      continue;
    }
    for (const int part : {node->first, node->second}) {
      if (part < 0) continue;
      const Node& of = nodes_[static_cast<std::size_t>(part)];
      node->centroid = node->centroid + of.centroid;
      node->r += of.r;
      node->g += of.g;
      node->b += of.b;
    }
  }
}

int MedianCut::mostLights() const {
  return static_cast<int>(std::count_if(nodes_.begin(), nodes_.end(), [](const Node& node) {
    return node.first < 0 && node.second < 0;
  }));
}

std::vector<DirectionalLight> MedianCut::lights(int regions) const {
  if (nodes_.empty()) return {};
  std::vector<char> isRegion(nodes_.size(), 0);
  isRegion[0] = 1;
  int count = 1;
  for (const int index : halved_) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (count >= regions) break;
    isRegion[static_cast<std::size_t>(index)] = 0;
    --count;
    for (const int part : {node.first, node.second}) {
      if (part < 0) continue;
      isRegion[static_cast<std::size_t>(part)] = 1;
      ++count;
    }
  }
  std::vector<DirectionalLight> lights;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (isRegion[i] == 0) continue;
    const Node& node = nodes_[i];
    lights.push_back(
        {Direction::fromVector(node.centroid),
         {static_cast<float>(node.r), static_cast<float>(node.g), static_cast<float>(node.b)}});
  }
  return lights;
}

std::vector<DirectionalLight> medianCut(const Environment& environment, int regions) {
  return MedianCut(environment, regions).lights(regions);
}

}  // namespace illum
