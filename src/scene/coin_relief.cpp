#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/bust.h"
#include "scene/coin.h"
#include "scene/random_numbers.h"
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

/// What years in purses do: ridges flatten, the field gets uneven and pitted.
void flatten(HeightMap& map) {
  const HeightMap around = map.blurred(map.side() / 90);
  for (int row = 0; row < map.side(); ++row) {
    for (int column = 0; column < map.side(); ++column) {
      const double x = map.coordinate(column), y = map.coordinate(row);
      const double above = map.at(column, row) - around.at(column, row);
      const double worn = 0.35 * std::max(0.0, above - 0.004);
      const double uneven = 0.0016 * valueNoise(x, y, 9, 1) + 0.0007 * valueNoise(x, y, 40, 2);
      const double pits = 0.0025 * smoothstep(0.78, 0.95, valueNoise(x, y, 55, 3));
      map.at(column, row) += static_cast<float>(uneven - worn - pits);
    }
  }
}

class Scratches {
 public:
  void cutInto(HeightMap& map) {
    constexpr int kScratches = 220;
    for (int i = 0; i < kScratches; ++i) cutOne(map);
  }

 private:
  /// An arc, deepest in its middle.
  void cutOne(HeightMap& map) {
    const double x = random_.uniform(-0.9, 0.9), y = random_.uniform(-0.9, 0.9),
                 angle = random_.uniform(0, kPi);
    const double length = random_.uniform(0.03, 0.35), depth = random_.uniform(0.0002, 0.0008);
    const double bend = random_.uniform(-0.6, 0.6);
    for (double t = 0; t < length; t += 0.7 * map.spacing()) {
      const double a = angle + bend * t;
      const int column = static_cast<int>(std::lround((x + t * std::cos(a) + 1) / map.spacing()));
      const int row = static_cast<int>(std::lround((y + t * std::sin(a) + 1) / map.spacing()));
      if (column < 0 || row < 0 || column >= map.side() || row >= map.side()) continue;
      map.at(column, row) -= static_cast<float>(depth * std::sin(kPi * t / length));
    }
  }

  RandomNumbers random_{79};
};

}  // namespace

HeightMap coinHeights(int side) {
  HeightMap map(side);
  strike(map);
  flatten(map);
  Scratches().cutInto(map);
  return map;
}

}  // namespace illum
