// Scenes in closed form, seen by any view: what synthesised views are held to.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "illum/lumigraph.h"

namespace illum {

/// A textured sphere before a textured square, both matt; nothing behind.
struct AnalyticScene {
  Vector3 centre{0, 0, 0};
  double radius = 0.45;
  double wallZ = -0.6, wallHalf = 0.9;

  struct Hit {
    Vector3 point;
    double red, green, blue;
  };
  std::optional<Hit> hit(const Ray& ray) const {
    std::optional<double> nearest;
    bool onSphere = false;
    const Vector3 way = ray.origin - centre;
    const double b = dot(way, ray.direction);
    const double root = b * b - dot(way, way) + radius * radius;
    if (root > 0 && -b - std::sqrt(root) > 0) {
      nearest = -b - std::sqrt(root);
      onSphere = true;
    }
    const double wall = (wallZ - ray.origin.z) / ray.direction.z;
    const Vector3 there = ray.origin + wall * ray.direction;
    if (wall > 0 && std::abs(there.x) < wallHalf && std::abs(there.y) < wallHalf &&
        (!nearest || wall < *nearest)) {
      nearest = wall;
      onSphere = false;
    }
    if (!nearest) return std::nullopt;
    const Vector3 p = ray.origin + *nearest * ray.direction;
    const double waves = onSphere ? 14 : 9;
    const double red = 0.5 + 0.4 * std::sin(waves * p.x) * std::cos(waves * p.y);
    const double green = 0.5 + 0.4 * std::cos(0.7 * waves * (p.x + p.y));
    return Hit{p, red, green, onSphere ? 0.8 : 0.2};
  }
};

/// RGBA and depth, `side` x `side` rays a pixel; depth that of the median ray that hits.
inline SourceView seen(const AnalyticScene& scene, const View& view, int side = 4) {
  const Size size = sizeOf(view.geometry);
  SourceView result{view, Picture(size, 4), Picture(size, 1)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      std::vector<double> depths;
      for (int i = 0; i < side * side; ++i) {
        const PixelPosition p{x + (i % side + 0.5) / side, y + (i / side + 0.5) / side};
        const auto hit = scene.hit(rayThrough(view.geometry, p));
        if (!hit) continue;
        const auto share = static_cast<float>(1.0 / (side * side));
        result.picture.at(x, y, 0) += share * static_cast<float>(hit->red);
        result.picture.at(x, y, 1) += share * static_cast<float>(hit->green);
        result.picture.at(x, y, 2) += share * static_cast<float>(hit->blue);
        result.picture.at(x, y, 3) += share;
        depths.push_back(depthOf(view.geometry, hit->point));
      }
      std::sort(depths.begin(), depths.end());
      result.depth.at(x, y, 0) =
          depths.empty() ? INFINITY : static_cast<float>(depths[depths.size() / 2]);
    }
  }
  return result;
}

/// Over all channels, of values in [0, 1]; 99 for equal pictures.
inline double decibels(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.samples().size(); ++i) {
    const double apart = static_cast<double>(a.samples()[i]) - b.samples()[i];
    sum += apart * apart;
  }
  return sum == 0 ? 99 : -10 * std::log10(sum / static_cast<double>(a.samples().size()));
}

/// A slab of `count` x `count` view points about +z, 30 degrees wide, seen by `pixels`^2.
inline LightSlab testSlab(int count, int pixels) {
  LightSlab slab;
  slab.name = "front";
  slab.distance = 3;
  slab.uv = {-0.8, -0.8, 0.8, 0.8};
  slab.uCount = slab.vCount = count;
  slab.st = {-1.1, -1.1, 1.1, 1.1};
  slab.size = {pixels, pixels};
  return slab;
}

inline std::vector<SourceView> seenBySlab(const AnalyticScene& scene, const LightSlab& slab) {
  std::vector<SourceView> views;
  for (int v = 0; v < slab.vCount; ++v) {
    for (int u = 0; u < slab.uCount; ++u) {
      const std::string name = slab.name + std::to_string(u) + "_" + std::to_string(v);
      views.push_back(seen(scene, {name, SlabView{slab, u, v}}));
    }
  }
  return views;
}

inline PinholeCamera cameraAt(Vector3 eye, Vector3 target, int pixels, double focal = 1.3) {
  PinholeCamera camera;
  camera.objectFromCamera = lookAt(eye, target, {0, 1, 0});
  camera.size = {pixels, pixels};
  camera.focalX = camera.focalY = focal * pixels;
  camera.centre = {0.5 * pixels, 0.5 * pixels};
  return camera;
}

}  // namespace illum
