#include <cmath>
#include <numbers>

#include "scene/bust.h"
#include "scene/random_numbers.h"
#include "scene/signed_distance.h"

namespace illum {
namespace {

constexpr Vector3 kMiddle{0, 0.24, -0.14};
constexpr Vector3 kRadii{0.665, 0.75, 0.83};

Vector3 unit(Vector3 v) {
  return (1 / lengthOf(v)) * v;
}

/// The point of the scalp in that direction from its middle, raised by `lift`.
Vector3 onScalp(Vector3 direction, double lift) {
  const Vector3 s{direction.x / kRadii.x, direction.y / kRadii.y, direction.z / kRadii.z};
  return kMiddle + (1 / lengthOf(s) + lift) * direction;
}

Vector3 outwardAt(Vector3 p) {
  const Vector3 q = p - kMiddle;
  return unit(
      {q.x / (kRadii.x * kRadii.x), q.y / (kRadii.y * kRadii.y), q.z / (kRadii.z * kRadii.z)});
}

/// Positive where hair grows: behind a line from the forehead past the ears to the nape.
double behindHairline(Vector3 p) {
  const double temples = 0.06 * std::cos(9 * p.x);  // recedes beside the forehead's middle
  return 0.57 * p.y - 0.82 * p.z + 0.06 + temples * (p.y > 0.3 ? 1 : 0);
}

/// Combed away from the forehead, falling at the sides.
Vector3 combed(Vector3 p, Vector3 outward) {
  const Vector3 forehead{0.12, 0.62, 0.62};
  const Vector3 away = unit(p - forehead);
  const double fall = std::abs(p.x) > 0.3 ? 1.1 : 0.35;
  const Vector3 flow = away - Vector3{0, fall, 0};
  return unit(flow - dot(flow, outward) * outward);
}

class Locks {
 public:
  std::vector<Strand> all() {
    constexpr int kDirections = 420;
    std::vector<Strand> locks;
    for (int i = 0; i < kDirections; ++i) {
      // Even over the sphere, by the golden angle (Gonzalez 2010).
      const double y = 1 - (2 * i + 1.0) / kDirections;
      const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
      const double across = std::sqrt(1 - y * y);
      const Vector3 direction{across * std::cos(azimuth), y, across * std::sin(azimuth)};
      if (behindHairline(onScalp(direction, 0)) > 0) locks.push_back(lock(direction));
    }
    return locks;
  }

 private:
  Strand lock(Vector3 direction) {
    constexpr int kSteps = 9;
    const double step = random_.uniform(0.06, 0.09);
    const double swirl = random_.uniform(-0.5, 0.5), curl = random_.uniform(-1, 1) > 0 ? 1 : -1;
    const double tightness = random_.uniform(0.12, 0.36);
    const double width = random_.uniform(0.055, 0.08), rise = random_.uniform(0.03, 0.12);
    Strand strand;
    strand.outward = outwardAt(onScalp(direction, 0));
    strand.grooves = 0.008;
    strand.grooveCount = 6;
    Vector3 at = direction;
    for (int i = 0; i <= kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps;
      const double lift = 0.02 + rise * std::sin(0.8 * std::numbers::pi * t);
      const Vector3 p = onScalp(at, lift);
      strand.points.push_back(p);
      strand.radii.push_back(width * (0.55 + 0.9 * t) * std::sqrt(std::max(0.03, 1 - t * t)));
      const Vector3 outward = outwardAt(p), along = combed(p, outward);
      const double turn = swirl + curl * tightness * (i + 0.18 * i * i) * 0.6;
      const Vector3 next =
          p + step * (std::cos(turn) * along + std::sin(turn) * cross(outward, along));
      at = unit(next - kMiddle);
    }
    return strand;
  }

  RandomNumbers random_{1827};
};

}  // namespace

std::vector<Strand> hairLocks() {
  return Locks().all();
}

}  // namespace illum
