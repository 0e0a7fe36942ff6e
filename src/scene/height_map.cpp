#include "scene/height_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace illum {
namespace {

double smooth(double t) {
  return t * t * (3 - 2 * t);
}

/// In [-1, 1), the same for the same point of the lattice.
double lattice(std::int64_t x, std::int64_t y, unsigned seed) {
  // Mixing as in splitmix64 (Steele, Lea, Flood 2014).
  std::uint64_t z = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u +
                    static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu + seed;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

}  // namespace

double valueNoise(double x, double y, double frequency, unsigned seed) {
  const double fx = std::floor(x * frequency), fy = std::floor(y * frequency);
  const double u = smooth(x * frequency - fx), v = smooth(y * frequency - fy);
  const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy);
  const double low = std::lerp(lattice(i, j, seed), lattice(i + 1, j, seed), u);
  const double high = std::lerp(lattice(i, j + 1, seed), lattice(i + 1, j + 1, seed), u);
  return std::lerp(low, high, v);
}

HeightMap::HeightMap(int side)
    : side_(side), values_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

float& HeightMap::at(int column, int row) {
  return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
                 static_cast<std::size_t>(column)];
}
float HeightMap::at(int column, int row) const {
  return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
                 static_cast<std::size_t>(column)];
}

double HeightMap::value(double x, double y) const {
  const double fx = std::clamp((x + 1) / spacing(), 0.0, side_ - 1.0);
  const double fy = std::clamp((y + 1) / spacing(), 0.0, side_ - 1.0);
  const int i = std::min(static_cast<int>(fx), side_ - 2);
  const int j = std::min(static_cast<int>(fy), side_ - 2);
  const double low = std::lerp(double{at(i, j)}, double{at(i + 1, j)}, fx - i);
  const double high = std::lerp(double{at(i, j + 1)}, double{at(i + 1, j + 1)}, fx - i);
  return std::lerp(low, high, fy - j);
}

HeightMap HeightMap::blurred(int reach) const {
  return blurredOnce(reach).blurredOnce(reach);
}

HeightMap HeightMap::blurredOnce(int reach) const {
  HeightMap rows(side_), both(side_);
  const auto mean = [&](const auto& value) {
    double sum = 0;
    for (int k = -reach; k <= reach; ++k) sum += value(k);
    return static_cast<float>(sum / (2 * reach + 1));
  };
  const auto inside = [&](int i) { return std::clamp(i, 0, side_ - 1); };
  for (int row = 0; row < side_; ++row) {
    for (int column = 0; column < side_; ++column)
      rows.at(column, row) = mean([&](int k) { return at(inside(column + k), row); });
  }
  for (int row = 0; row < side_; ++row) {
    for (int column = 0; column < side_; ++column)
      both.at(column, row) = mean([&](int k) { return rows.at(column, inside(row + k)); });
  }
  return both;
}

}  // namespace illum
