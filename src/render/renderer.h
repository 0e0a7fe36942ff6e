// Radiance of a scene under many directional lights at once.
//
// Every light is a disc of uniform radiance at infinity whose irradiance on a surface that faces it
// is pi: a white Lambertian surface then has the value 1 (docs/conventions.md, "Radiometry").
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "illum/camera.h"
#include "illum/picture.h"
#include "scene/scene.h"

namespace illum {

struct RenderSettings {
  double lightRadiusRadians = 0;  ///< [0, pi/2); 0: no disc, sharp shadows, unseen by mirrors
  int samplesPerPixel = 4;
  int bounces = 1;
  double filterRadius = 0.75;  ///< pixels
  std::uint64_t seed = 0;
};

/// A light of the capture: random numbers depend on `id`, so that a light renders the same whatever
/// others are asked for beside it.
struct RenderLight {
  Direction toLight;  ///< object frame
  int id = 0;
};

/// Thread safe; a pixel's values depend on nothing but scene, settings, view, position and light.
class Renderer {
 public:
  /// Copies what it needs of the scene. Throws Error (Fault::Input) for what cannot be traced.
  Renderer(const Scene& scene, const RenderSettings& settings);
  ~Renderer();

  /// samples[(3*l + c) * rectangle.pixels() + p], linear, of the covered part of a pixel (not
  /// premultiplied; 0 where nothing is hit). One thread: call it from tasks.
  void render(const View& view, const Rectangle& rectangle, std::span<const RenderLight> lights,
              std::span<float> samples) const;

  /// The same camera rays without light: coverage in [0, 1] and the median depth (camera.h,
  /// depthOf) of those that hit; infinity where none does. Either span may be empty.
  void trace(const View& view, const Rectangle& rectangle, std::span<float> coverage,
             std::span<float> depth) const;

  /// Bytes held beside the scene's own: tree and buffers.
  std::uint64_t residentBytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace illum
