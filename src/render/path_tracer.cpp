#include "render/path_tracer.h"

#include <limits>
#include <numbers>

#include "render/dielectric.h"
#include "render/hair_bsdf.h"
#include "render/surface_bsdf.h"

namespace illum {
namespace {

// Mirrors and glass in a row, before the path is given up.
constexpr int kMostIdeal = 16;
// How a beam widens when it leaves a rough surface: for textures alone.
constexpr float kScatteredSpread = 0.15f;

// Numbers of dimensions: 0 is the camera's, each corner of the path has these.
enum Purpose : std::uint32_t { kDisc, kScatter, kChoice, kPurposes };

LinearRgb product(LinearRgb a, LinearRgb b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

// Multiple importance sampling by the power heuristic (Veach and Guibas 1995).
float share(float density, float other) {
  const float a = density * density, b = other * other;
  return a / (a + b);
}

// Of microfacets that draw directions with this density at the middle of their highlight,
// 1 / (4 pi alpha^2), but not more than enough to have no narrow highlights.
float roughnessOf(float density) {
  constexpr float kMost = 0.6f;
  return std::min(kMost, std::pow(4 * std::numbers::pi_v<float> * density, -0.25f));
}

// How far a new ray has to go to be outside the fibre on which it starts. The chord through a round
// fibre is 2 r cos / sin^2 long.
float wayOut(const SurfacePoint& point, Float3 direction) {
  const float inward = -dot(point.geometricNormal, direction);
  const float along = dot(point.tangent, direction);
  const float across = std::max(0.05f, 1 - along * along);
  const float chord = std::max(0.0f, 2 * point.hairRadius * inward / across);
  return point.clearance + 0.05f * point.hairRadius + 1.05f * chord;
}

struct RayStart {
  Float3 origin;
  float start;
};
RayStart startOf(const SurfacePoint& point, Float3 direction) {
  if (point.kind == Material::Kind::Hair) return {point.position, wayOut(point, direction)};
  return {point.startToward(direction), 0};
}

}  // namespace

struct PathTracer::Path {
  BeamRay beam;
  float start = 0;
  const SampleSequence& sequence;
  LinearRgb throughput{1, 1, 1};
  int corner = 0, bounces = 0, idealInARow = 0;
  /// Behind a corner where it was spread, a path takes nothing for smoother than what spread it:
  /// the few that hit a narrow highlight would be specks (after Kaplanyan and Dachsbacher 2013,
  /// "Path space regularization").
  float leastRoughness = 0;
  /// The share of what a disc sends that this path has to account for, given as the density with
  /// which the direction was drawn: infinite where nothing else could find it, 0 where other paths
  /// account for all.
  float discDensity = std::numeric_limits<float>::infinity();

  std::array<float, 2> numbers(Purpose purpose) const {
    return sequence.pair(1 + kPurposes * static_cast<std::uint32_t>(corner) + purpose);
  }
  void go(const SurfacePoint& point, Float3 direction, float spread) {
    const RayStart from = startOf(point, direction);
    beam = {from.origin, direction, point.beamWidth, spread};
    start = from.start;
    ++corner;
  }
};

bool PathTracer::trace(const BeamRay& beam, const SampleSequence& sequence, LightSums& sums) {
  Path path{beam, 0, sequence};
  for (;;) {
    const auto hit = tree_.nearest(path.beam.origin, path.beam.direction, path.start);
    if (!hit) {
      if (path.corner == 0) return false;
      addDiscs(path, sums);
      return true;
    }
    if (path.bounces > bounces_) return true;
    SurfacePoint point = surfaces_.at(*hit, path.beam);
    point.roughness = std::max(point.roughness, path.leastRoughness);
    bool goesOn = false;
    switch (point.kind) {
      case Material::Kind::Mirror:
      case Material::Kind::Glass:
        goesOn = ideal(point, path);
        break;
      case Material::Kind::Hair:
        goesOn = scatter(point, HairBsdf(point, -path.beam.direction), path, sums);
        break;
      case Material::Kind::Surface:
        goesOn = scatter(point, SurfaceBsdf(point, -path.beam.direction), path, sums);
        break;
    }
    if (!goesOn) return true;
  }
}

// Mirrors and glass: one direction, of which no light can be told beforehand.
bool PathTracer::ideal(const SurfacePoint& point, Path& path) const {
  if (++path.idealInARow > kMostIdeal) return false;
  const Float3 toViewer = -path.beam.direction;
  Float3 reflected = mirrored(toViewer, point.shadingNormal);
  if (dot(reflected, point.geometricNormal) <= 0) {
    reflected = mirrored(toViewer, point.geometricNormal);
  }
  Float3 direction = reflected;
  if (point.kind == Material::Kind::Mirror) {
    path.throughput = product(path.throughput, point.colour);
  } else {
    const float relativeIor = point.fromBehind ? 1 / point.ior : point.ior;
    const auto through = refracted(toViewer, point.shadingNormal, relativeIor);
    if (through && dot(*through, point.geometricNormal) < 0) {
      // The reflectance is the same from both sides; it is told by the angle outside.
      const float outside = point.fromBehind ? std::abs(dot(*through, point.shadingNormal))
                                             : dot(toViewer, point.shadingNormal);
      if (path.numbers(kChoice)[0] >= dielectricReflectance(outside, point.ior)) {
        direction = *through;
        path.throughput = product(path.throughput, point.colour);
      }
    }
  }
  // Behind a rough surface shadow rays stand for light through glass, and light by way of mirrors
  // is left out.
  if (path.bounces > 0) path.discDensity = 0;
  path.go(point, direction, path.beam.spread);
  return true;
}

template <typename Bsdf>
bool PathTracer::scatter(const SurfacePoint& point, const Bsdf& bsdf, Path& path, LightSums& sums) {
  const bool alsoDrawn = lights_.areDiscs() && bsdf.isGlossy();
  addLights(point, bsdf, path, alsoDrawn, sums);
  if (path.bounces == bounces_ && !alsoDrawn) return false;
  const auto sample = bsdf.sample(path.numbers(kChoice)[0], path.numbers(kScatter));
  if (!sample) return false;
  path.throughput = product(path.throughput, sample->weight);
  path.discDensity = alsoDrawn ? sample->density : 0;
  path.leastRoughness = std::max(path.leastRoughness, roughnessOf(sample->density));
  path.idealInARow = 0;
  ++path.bounces;
  path.go(point, sample->direction, kScatteredSpread);
  return true;
}

// Light from all lights straight to `point` and on along the path. `alsoDrawn`: drawn directions
// find the discs as well, and account for their share.
template <typename Bsdf>
void PathTracer::addLights(const SurfacePoint& point, const Bsdf& bsdf, const Path& path,
                           bool alsoDrawn, LightSums& sums) {
  const auto onDisc = path.numbers(kDisc);
  const LinearRgb weight = lights_.weight() * path.throughput;
  for (std::size_t first = 0; first < lights_.count(); first += kBatch) {
    const std::size_t count = std::min(kBatch, lights_.count() - first);
    const DirectionBatch& directions = lights_.draw(first / kBatch, onDisc, directions_);
    bsdf.evaluate(directions, count, values_);

    const std::size_t rays = aimAt(point, directions, count);
    if (alsoDrawn) {
      for (std::size_t i = 0; i < count; ++i) {
        shares_[i] = share(lights_.density(), values_.density[i]);
      }
    }
    if (tree_.hasGlass()) depths_.fill({});
    tree_.shadows({rays_.data(), rays}, depths_);
    for (std::size_t r = 0; r < rays; ++r) {
      if (rays_[r].end < 0) continue;
      const std::size_t i = rays_[r].id;
      LinearRgb value{values_.r[i] * weight.r, values_.g[i] * weight.g, values_.b[i] * weight.b};
      if (tree_.hasGlass() && depths_[i] != OpticalDepth{}) {
        value = product(value, transmittance(depths_[i]));  // no drawn direction comes here
      } else if (alsoDrawn) {
        value = shares_[i] * value;
      }
      sums.add(first + i, value);
    }
  }
}

// Shadow rays to those lights of a batch from which `values_` has anything, their number.
std::size_t PathTracer::aimAt(const SurfacePoint& point, const DirectionBatch& directions,
                              std::size_t count) {
  const bool isHair = point.kind == Material::Kind::Hair;
  // All that counts is on the viewer's side of a surface.
  RayStart from = startOf(point, point.geometricNormal);
  std::size_t rays = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(values_.r[i] + values_.g[i] + values_.b[i] > 0)) continue;
    const Float3 direction{directions.x[i], directions.y[i], directions.z[i]};
    if (isHair) from = startOf(point, direction);
    rays_[rays++] = {.originX = from.origin.x,
                     .originY = from.origin.y,
                     .originZ = from.origin.z,
                     .start = from.start,
                     .directionX = direction.x,
                     .directionY = direction.y,
                     .directionZ = direction.z,
                     .end = std::numeric_limits<float>::infinity(),
                     .id = static_cast<std::uint32_t>(i)};
  }
  return rays;
}

// The path has left the scene: what it sees there.
void PathTracer::addDiscs(const Path& path, LightSums& sums) const {
  if (!lights_.areDiscs() || path.discDensity == 0) return;
  const float part = std::isinf(path.discDensity) ? 1 : share(path.discDensity, lights_.density());
  const LinearRgb value = (part * lights_.radiance()) * path.throughput;
  lights_.forDiscsAt(path.beam.direction, [&](std::size_t l) { sums.add(l, value); });
}

}  // namespace illum
