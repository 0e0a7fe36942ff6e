#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "scene/bust.h"
#include "scene/coin.h"
#include "scene/rod_cloud.h"
#include "scene/signed_distance.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A round cap: `height` at distance 0, nothing beyond `radius`.
double cap(double distance, double radius, double height) {
  const double t = distance / radius;
  return t < 1 ? height * std::sqrt(1 - t * t) : 0;
}

double beads(double r, double angle, int count, double ring, double radius) {
  const double step = 2 * kPi / count;
  const double across = ring * (angle - step * std::round(angle / step));
  return cap(std::hypot(r - ring, across), radius, 0.7 * radius);
}

/// The bust's head, looking to the left.
class Profile {
 public:
  /// How far it comes toward the viewer, in half heights of the head; negative beside it.
  double depth(double x, double y) const {
    const double scale = 1 / 0.50;
    const double ahead = -scale * (x + 0.02), up = scale * (y + 0.03) + 0.02;
    double toward = 0.95;
    for (int i = 0; i < 60 && toward > 0; ++i) {
      const Vector3 p{toward, up, ahead};
      const double d = smoothIntersection(distance(p), cut(p), 0.03);
      if (d < 1e-3) return toward;
      toward -= 0.8 * d;
    }
    return -1;
  }

 private:
  double distance(Vector3 p) const {
    const double head = headDistance(p);
    return head < 0.4 ? smoothUnion(head, hair_.distance(p), 0.02) : head;
  }
  /// The neck ends in a bow.
  static double cut(Vector3 p) { return std::hypot(p.y - 0.1, 0.9 * (p.z + 0.1)) - 1.24; }

  RodCloud hair_{hairLocks(), 0.016, 0.1};
};

void strike(HeightMap& map) {
  const Profile profile;
  for (int row = 0; row < map.side(); ++row) {
    for (int column = 0; column < map.side(); ++column) {
      const double x = map.coordinate(column), y = map.coordinate(row);
      const double r = std::hypot(x, y);
      double height = 0.055;
      height += 0.05 * smoothstep(0.845, 0.868, r) * (1 - smoothstep(0.895, 0.93, r));
      height += beads(r, std::atan2(y, x), 96, 0.815, 0.021);
      if (r > 0.6 && r < 0.8) {
        height +=
            0.022 * smoothstep(0.016, 0.006, distanceToLetters("ILLUMIGRAPH", 0.66, 0.105, x, y));
      }
      if (r < 0.68) {
        const double depth = profile.depth(x, y);
        if (depth > 0) height = std::max(height, 0.052 + 0.115 * std::pow(depth / 0.75, 0.65));
      }
      map.at(column, row) = static_cast<float>(height);
    }
  }
}

/// What years in purses do: ridges flatten, the field gets pits and scratches.
void wear(HeightMap& map) {
  const HeightMap around = map.blurred(map.side() / 90);
  std::mt19937_64 random(79);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int row = 0; row < map.side(); ++row) {
    for (int column = 0; column < map.side(); ++column) {
      const double x = map.coordinate(column), y = map.coordinate(row);
      const double above = map.at(column, row) - around.at(column, row);
      double height = map.at(column, row) - 0.35 * std::max(0.0, above - 0.004);
      height += 0.0016 * valueNoise(x, y, 9, 1) + 0.0007 * valueNoise(x, y, 40, 2);
      const double pits = valueNoise(x, y, 55, 3);
      height -= 0.0025 * smoothstep(0.78, 0.95, pits);
      map.at(column, row) = static_cast<float>(height);
    }
  }
  constexpr int kScratches = 220;
  for (int i = 0; i < kScratches; ++i) {
    const double x = uniform(-0.9, 0.9), y = uniform(-0.9, 0.9), angle = uniform(0, kPi);
    const double length = uniform(0.03, 0.35), depth = uniform(0.0005, 0.0022);
    const double bend = uniform(-0.6, 0.6);
    for (double t = 0; t < length; t += 0.7 * map.spacing()) {
      const double a = angle + bend * t;
      const int column = static_cast<int>(std::lround((x + t * std::cos(a) + 1) / map.spacing()));
      const int row = static_cast<int>(std::lround((y + t * std::sin(a) + 1) / map.spacing()));
      if (column < 0 || row < 0 || column >= map.side() || row >= map.side()) continue;
      const double deep = depth * std::sin(kPi * t / length);
      map.at(column, row) =
          std::min(map.at(column, row), static_cast<float>(around.at(column, row) + 0.03));
      map.at(column, row) -= static_cast<float>(0.35 * deep);
    }
  }
}

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
  const double u = smoothstep(0, 1, x * frequency - fx), v = smoothstep(0, 1, y * frequency - fy);
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

HeightMap coinHeights(int side) {
  HeightMap map(side);
  strike(map);
  wear(map);
  return map;
}

}  // namespace illum
